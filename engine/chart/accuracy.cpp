#include "engine/chart/accuracy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/diagnostics/convergence.h"

namespace patina {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Collects errors; keeps the largest.
class Worst {
 public:
  void add(const std::string& of, double value, double bar) {
    if (std::isnan(value)) return;
    if (std::isnan(worst_.value) || value > worst_.value) {
      worst_.value = value;
      worst_.bar = bar;
      worst_.of = of;
    }
    if (value > 0) worst_.largest_bars = std::max(worst_.largest_bars, value / bar);
  }
  WorstError get() const { return worst_; }

 private:
  WorstError worst_{kNaN, kNaN, "", 0};
};

double standard_deviation(const Eigen::MatrixXd& draws) {
  return std::sqrt((draws.array() - draws.mean()).square().sum() / static_cast<double>(draws.size() - 1));
}

bool never_changes(const Eigen::MatrixXd& draws) { return draws.minCoeff() == draws.maxCoeff(); }

/// Half the sum over levels of |difference of shares|, and of what that may be by chance.
std::pair<double, double> total_variation(const Eigen::MatrixXd& draws, const Eigen::MatrixXd& gold) {
  double distance = 0, bar = 0;
  const int highest = static_cast<int>(std::max(draws.maxCoeff(), gold.maxCoeff()));
  for (int level = 0; level <= highest; ++level) {
    const Eigen::MatrixXd here = (draws.array() == level).cast<double>();
    const Eigen::MatrixXd there = (gold.array() == level).cast<double>();
    distance += 0.5 * std::abs(here.mean() - there.mean());
    bar += 0.5 * std::hypot(mcse_mean(here), mcse_mean(there));
  }
  return {distance, bar};
}

/// Of a continuous quantity. One that never moved is worth one draw.
double effective(const Eigen::MatrixXd& draws) { return never_changes(draws) ? 1 : bulk_ess(draws); }

}  // namespace

Accuracy compare(const QuantityDraws& draws, const GoldStandard& gold, std::uint64_t seed) {
  Accuracy result;
  Worst mean, sd, wasserstein, levels;
  Rng rng(seed);
  result.least_ess = result.largest_rhat = kNaN;
  const auto judge = [&](const std::string& name, double ess, double rhat) {
    result.largest_rhat = std::fmax(result.largest_rhat, rhat);
    if (!(ess < result.least_ess) && !std::isnan(result.least_ess)) return;
    result.least_ess = ess;
    result.least_ess_of = name;
  };
  constexpr Eigen::Index kFewest = 4;  // of a chain, for the diagnostics to say anything
  if (draws.draws() < kFewest) return {mean.get(), sd.get(), wasserstein.get(), levels.get(), kNaN, "", kNaN};
  for (std::size_t q = 0; q < draws.continuous.size(); ++q) {
    const Eigen::MatrixXd& x = draws.continuous[q];
    const GoldQuantity& truth = gold.continuous()[q];
    mean.add(truth.name, std::abs(x.mean() - truth.mean) / truth.sd,
             std::hypot(mcse_mean(x), truth.mcse_mean) / truth.sd);
    const double own_sd = standard_deviation(x);
    sd.add(truth.name, std::abs(std::log(own_sd / truth.sd)),
           std::hypot(mcse_sd(x) / own_sd, truth.mcse_sd / truth.sd));
    const BlockedSample sample(x, mean_ess(x));
    wasserstein.add(truth.name, wasserstein_1(sample.sorted(), gold.samples()[q].sorted()) / truth.sd,
                    std::hypot(sample.distance_to_law(rng), gold.distances_to_law()[q]) / truth.sd);
    judge(truth.name, effective(x), split_rhat(x));
  }
  for (std::size_t q = 0; q < draws.discrete.size(); ++q) {
    const Eigen::MatrixXd& x = draws.discrete[q];
    const GoldQuantity& truth = gold.discrete()[q];
    const auto [distance, bar] = total_variation(x, truth.draws);
    levels.add(truth.name, distance, bar);
    // A level that the posterior never leaves asks for no draws.
    if (never_changes(x) && never_changes(truth.draws)) continue;
    judge(truth.name, effective(x), split_rhat(x));
  }
  result.mean = mean.get();
  result.sd = sd.get();
  result.wasserstein = wasserstein.get();
  result.levels = levels.get();
  return result;
}

}  // namespace patina
