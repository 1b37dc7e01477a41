#include "engine/diagnostics/convergence.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/diagnostics/effective_sample_size.h"
#include "engine/diagnostics/ranks.h"

namespace patina {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool defined(ChainDraws draws) { return draws.rows() >= 4 && draws.cols() >= 1 && draws.allFinite(); }

bool constant(ChainDraws draws) { return draws.minCoeff() == draws.maxCoeff(); }

/// Gelman-Rubin R-hat of chains as they are (Vehtari et al. 2021, equations 1-4).
double basic_rhat(const Eigen::MatrixXd& chains) {
  const auto n = static_cast<double>(chains.rows());
  const Eigen::ArrayXd means = chains.colwise().mean();
  const Eigen::MatrixXd centred = chains.rowwise() - means.matrix().transpose();
  const double within = centred.squaredNorm() / (n - 1) / static_cast<double>(chains.cols());
  const double between_over_n = (means - means.mean()).square().sum() / static_cast<double>(means.size() - 1);
  return std::sqrt(between_over_n / within + (n - 1) / n);
}

double split_ess(ChainDraws draws) {
  return constant(draws) ? static_cast<double>(draws.size()) : effective_sample_size(split_chains(draws));
}

/// ESS of the share of draws up to the quantile.
double quantile_ess(ChainDraws draws, double probability) {
  std::vector<double> values = pooled_values(draws);
  const double bound = quantile_of(values, probability);
  return split_ess((draws.array() <= bound).cast<double>());
}

/// The x with I_x(a, b) = probability, by bisection to the last bit.
double beta_quantile(double a, double b, double probability) {
  double low = 0, high = 1;
  for (double middle = 0.5; low < middle && middle < high; middle = 0.5 * (low + high))
    (Eigen::numext::betainc(a, b, middle) < probability ? low : high) = middle;
  return high;
}

}  // namespace

double split_rhat(ChainDraws draws) {
  if (!defined(draws) || constant(draws)) return kNaN;
  const Eigen::MatrixXd split = split_chains(draws);
  std::vector<double> values = pooled_values(split);
  const double median = quantile_of(values, 0.5);
  const Eigen::MatrixXd folded = (split.array() - median).abs();
  // Two values alone fold onto one: then there is no spread to compare, and fmax drops the NaN.
  return std::fmax(basic_rhat(rank_normalise(split)), basic_rhat(rank_normalise(folded)));
}

double bulk_ess(ChainDraws draws) {
  if (!defined(draws)) return kNaN;
  if (constant(draws)) return static_cast<double>(draws.size());
  return effective_sample_size(rank_normalise(split_chains(draws)));
}

double tail_ess(ChainDraws draws) {
  if (!defined(draws)) return kNaN;
  return std::min(quantile_ess(draws, 0.05), quantile_ess(draws, 0.95));
}

double mean_ess(ChainDraws draws) { return defined(draws) ? split_ess(draws) : kNaN; }

double mcse_mean(ChainDraws draws) {
  if (!defined(draws)) return kNaN;
  if (constant(draws)) return 0;
  const double variance =
      (draws.array() - draws.mean()).square().sum() / static_cast<double>(draws.size() - 1);
  return std::sqrt(variance / split_ess(draws));
}

double mcse_sd(ChainDraws draws) {
  if (!defined(draws)) return kNaN;
  if (constant(draws)) return 0;
  const Eigen::MatrixXd squares = (draws.array() - draws.mean()).square();
  const double variance = squares.mean();
  const double variance_of_squares = squares.array().square().mean() - variance * variance;
  return std::sqrt(variance_of_squares / split_ess(squares) / (4 * variance));
}

double mcse_quantile(ChainDraws draws, double probability) {
  if (!defined(draws) || !(probability >= 0 && probability <= 1)) return kNaN;
  const double ess = quantile_ess(draws, probability);
  const double a = probability * ess + 1, b = (1 - probability) * ess + 1;
  const auto size = static_cast<double>(draws.size());
  // One standard deviation of a normal to either side, with the digits of the R package posterior.
  const double low = std::max(std::floor(beta_quantile(a, b, 0.1586553) * size), 1.0);
  const double high = std::min(std::ceil(beta_quantile(a, b, 0.8413447) * size), size);
  std::vector<double> values = pooled_values(draws);
  const double at_low = order_statistic(values, static_cast<std::size_t>(low) - 1);
  return (order_statistic(values, static_cast<std::size_t>(high) - 1) - at_low) / 2;
}

double quantile(ChainDraws draws, double probability) {
  if (!defined(draws) || !(probability >= 0 && probability <= 1)) return kNaN;
  std::vector<double> values = pooled_values(draws);
  return quantile_of(values, probability);
}

double standard_deviation(ChainDraws draws) {
  return std::sqrt((draws.array() - draws.mean()).square().sum() / static_cast<double>(draws.size() - 1));
}

double ebfmi(const Eigen::Ref<const Eigen::VectorXd>& energy) {
  if (!defined(energy) || constant(energy)) return kNaN;
  const Eigen::Index n = energy.size();
  const double change = (energy.tail(n - 1) - energy.head(n - 1)).squaredNorm() / static_cast<double>(n - 1);
  return change / (energy.array() - energy.mean()).square().mean();
}

}  // namespace patina
