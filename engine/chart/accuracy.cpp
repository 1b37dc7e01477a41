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

/// Draws being compared, quantity by quantity.
class Comparison {
 public:
  explicit Comparison(std::uint64_t seed) : rng_(seed) {}

  void add_continuous(const Eigen::MatrixXd& x, const GoldQuantity& truth, const BlockedSample& gold,
                      double gold_distance) {
    mean_.add(truth.name, std::abs(x.mean() - truth.mean) / truth.sd,
              std::hypot(mcse_mean(x), truth.mcse_mean) / truth.sd);
    const double sd = standard_deviation(x);
    sd_.add(truth.name, std::abs(std::log(sd / truth.sd)),
            std::hypot(mcse_sd(x) / sd, truth.mcse_sd / truth.sd));
    const BlockedSample sample(x, mean_ess(x));
    wasserstein_.add(truth.name, wasserstein_1(sample.sorted(), gold.sorted()) / truth.sd,
                     std::hypot(sample.distance_to_law(rng_), gold_distance) / truth.sd);
    judge(truth.name, x);
  }

  void add_discrete(const Eigen::MatrixXd& x, const GoldQuantity& truth) {
    const auto [distance, bar] = total_variation(x, truth.draws);
    levels_.add(truth.name, distance, bar);
    // A level that the posterior never leaves asks for no draws.
    if (!never_changes(x) || !never_changes(truth.draws)) judge(truth.name, x);
  }

  Accuracy get() const {
    return {mean_.get(), sd_.get(),     wasserstein_.get(), levels_.get(),
            least_ess_,  least_ess_of_, largest_rhat_};
  }

 private:
  /// What never moved is worth one draw.
  void judge(const std::string& name, const Eigen::MatrixXd& x) {
    largest_rhat_ = std::fmax(largest_rhat_, split_rhat(x));
    const double ess = never_changes(x) ? 1 : bulk_ess(x);
    if (ess >= least_ess_) return;
    least_ess_ = ess;
    least_ess_of_ = name;
  }

  Worst mean_, sd_, wasserstein_, levels_;
  double least_ess_ = kNaN, largest_rhat_ = kNaN;
  std::string least_ess_of_;
  Rng rng_;
};

}  // namespace

Accuracy compare(const QuantityDraws& draws, const GoldStandard& gold, std::uint64_t seed) {
  constexpr Eigen::Index kFewest = 4;  // of a chain, for the diagnostics to say anything
  Comparison comparison(seed);
  if (draws.draws() < kFewest) return comparison.get();
  for (std::size_t q = 0; q < draws.continuous.size(); ++q)
    comparison.add_continuous(draws.continuous[q], gold.continuous()[q], gold.samples()[q],
                              gold.distances_to_law()[q]);
  for (std::size_t q = 0; q < draws.discrete.size(); ++q)
    comparison.add_discrete(draws.discrete[q], gold.discrete()[q]);
  return comparison.get();
}

}  // namespace patina
