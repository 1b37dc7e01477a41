#include "engine/chart/gold_standard.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagnostics/convergence.h"
#include "engine/error.h"

namespace patina {
namespace {

constexpr Eigen::Index kMostDraws = 4000;  // of each chain
constexpr double kConverged = 1.01;
constexpr std::uint64_t kBootstrapSeed = 11;

GoldQuantity quantity(const std::string& name, const Eigen::MatrixXd& draws) {
  GoldQuantity result{name, draws};
  result.mean = draws.mean();
  result.sd = standard_deviation(draws);
  result.mcse_mean = mcse_mean(draws);
  result.mcse_sd = mcse_sd(draws);
  result.rhat = split_rhat(draws);
  result.bulk_ess = std::isnan(result.rhat) ? std::numeric_limits<double>::quiet_NaN() : bulk_ess(draws);
  return result;
}

/// So many rows, evenly spread.
Eigen::MatrixXd thinned(const Eigen::MatrixXd& draws, Eigen::Index rows) {
  Eigen::MatrixXd result(rows, draws.cols());
  for (Eigen::Index i = 0; i < rows; ++i) result.row(i) = draws.row((i + 1) * draws.rows() / rows - 1);
  return result;
}

/// Appends chains to those that are there.
void join(std::vector<Eigen::MatrixXd>& all, const std::vector<Eigen::MatrixXd>& more, Eigen::Index rows) {
  all.resize(more.size());
  for (std::size_t q = 0; q < more.size(); ++q) {
    const Eigen::Index before = all[q].cols();
    all[q].conservativeResize(rows, before + more[q].cols());
    all[q].rightCols(more[q].cols()) = thinned(more[q], rows);
  }
}

}  // namespace

std::vector<ChartSetting> gold_settings(const ChartSetting& usual) {
  ChartSetting first = usual;
  first.errors = "paper";
  ChartSetting second = first;
  first.name = "gold: " + first.kernel + " " + first.metric;
  second.kernel = "mala";
  second.metric = "dense";
  second.refresh = first.refresh * 2 / 3;
  second.name = "gold: " + second.kernel + " " + second.metric;
  return {first, second};
}

GoldStandard::GoldStandard(const QuantityDraws& draws, const std::vector<std::string>& names) {
  Rng rng(kBootstrapSeed);
  auto name = names.begin();
  for (const Eigen::MatrixXd& matrix : draws.continuous) {
    continuous_.push_back(quantity(*name++, matrix));
    samples_.emplace_back(matrix, mean_ess(matrix));
    distances_to_law_.push_back(samples_.back().distance_to_law(rng));
  }
  for (const Eigen::MatrixXd& matrix : draws.discrete) discrete_.push_back(quantity(*name++, matrix));
}

QuantityDraws GoldStandard::draws() const {
  QuantityDraws result;
  for (const GoldQuantity& quantity : continuous_) result.continuous.push_back(quantity.draws);
  for (const GoldQuantity& quantity : discrete_) result.discrete.push_back(quantity.draws);
  return result;
}

std::vector<const GoldQuantity*> GoldStandard::judged() const {
  std::vector<const GoldQuantity*> result;
  for (const auto* quantities : {&continuous_, &discrete_})
    for (const GoldQuantity& quantity : *quantities)
      if (!std::isnan(quantity.rhat)) result.push_back(&quantity);
  if (result.empty()) result.push_back(continuous_.empty() ? &discrete_.front() : &continuous_.front());
  return result;
}

const GoldQuantity& GoldStandard::least_converged() const {
  const auto judged = this->judged();
  return **std::ranges::max_element(judged, {}, &GoldQuantity::rhat);
}

const GoldQuantity& GoldStandard::least_effective() const {
  const auto judged = this->judged();
  return **std::ranges::min_element(judged, {}, &GoldQuantity::bulk_ess);
}

bool GoldStandard::is_gold() const {
  const bool moved = std::ranges::all_of(continuous_, [](const auto& q) { return !std::isnan(q.rhat); });
  return moved && least_converged().rhat <= kConverged;
}

QuantityDraws draw_gold(const ChartProblem& problem, const GoldPlan& plan) {
  std::vector<QuantityDraws> parts;
  Eigen::Index rows = kMostDraws;
  for (const ChartSetting& setting : plan.settings) {
    parts.push_back(run_trial(problem, setting, plan.trial).draws());
    rows = std::min(rows, parts.back().draws());
  }
  constexpr Eigen::Index kFewest = 8;
  if (rows < kFewest)
    throw UserError(
        "The gold standard has no draws to speak of after its time: give it more with --gold-minutes.");
  QuantityDraws all;
  for (const QuantityDraws& part : parts) {
    join(all.continuous, part.continuous, rows);
    join(all.discrete, part.discrete, rows);
  }
  return all;
}

}  // namespace patina
