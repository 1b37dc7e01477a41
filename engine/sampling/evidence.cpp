#include "engine/sampling/evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace patina {

double log_sum_exp(const std::vector<double>& terms) {
  if (terms.empty()) return -std::numeric_limits<double>::infinity();
  const double top = *std::ranges::max_element(terms);
  if (!std::isfinite(top)) return top;
  return top + std::log(std::accumulate(terms.begin(), terms.end(), 0.0,
                                        [&](double sum, double term) { return sum + std::exp(term - top); }));
}

double laplace_log_evidence(const std::vector<NormalBasin>& basins, const std::vector<int>& levels) {
  double log_tables = 0;
  for (const int count : levels) log_tables += std::log(count);
  std::vector<double> terms;
  for (const auto& [mode, covariance] : basins) {
    // The prior's constants cancel against the normal integral's, (2 pi)^(d / 2).
    const double log_volume = Eigen::MatrixXd(covariance.llt().matrixL()).diagonal().array().log().sum();
    terms.push_back(mode.evaluation.log_density + log_volume - log_tables);
  }
  return log_sum_exp(terms);
}

}  // namespace patina
