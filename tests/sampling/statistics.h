#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace patina::testing_statistics {

inline double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// Kolmogorov's distance between a sample and a distribution function.
inline double ks_distance(std::vector<double> sample, const std::function<double(double)>& cdf) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double distance = 0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double p = cdf(sample[i]);
    distance = std::max({distance, p - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p});
  }
  return distance;
}

/// What ks_distance() of n independent draws exceeds with probability alpha at most
/// (Dvoretzky-Kiefer-Wolfowitz inequality with Massart's constant).
inline double dkw_bound(std::size_t n, double alpha) {
  return std::sqrt(std::log(2 / alpha) / (2 * static_cast<double>(n)));
}

/// (mean - expected) / standard error of independent values.
inline double z_score(const std::vector<double>& values, double expected) {
  const auto sample = Eigen::ArrayXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
  const auto n = static_cast<double>(values.size());
  const double variance = (sample - sample.mean()).square().sum() / (n - 1);
  return (sample.mean() - expected) / std::sqrt(variance / n);
}

}  // namespace patina::testing_statistics
