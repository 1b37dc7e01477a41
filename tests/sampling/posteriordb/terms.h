#pragma once

#include <cmath>
#include <numbers>

namespace patina::posteriordb {

/// A log density's value, and its slope in each of its arguments, as terms of a sum are built from.
struct NormalTerm {
  double value, by_x, by_scale;  ///< the slope by the mean is -by_x
};

/// N(x | mean, scale), all constants kept.
inline NormalTerm normal(double x, double mean, double scale) {
  const double z = (x - mean) / scale;
  return {-0.5 * z * z - std::log(scale) - 0.5 * std::log(2 * std::numbers::pi), -z / scale,
          (z * z - 1) / scale};
}

struct CauchyTerm {
  double value, by_x;
};

/// Cauchy(x | 0, scale), all constants kept.
inline CauchyTerm cauchy(double x, double scale) {
  const double z = x / scale;
  return {-std::log(std::numbers::pi * scale * (1 + z * z)), -2 * z / (scale * (1 + z * z))};
}

/// log of the logistic function; its slope is 1 / (1 + e^v).
inline double log_logistic(double v) {
  return v > 0 ? -std::log1p(std::exp(-v)) : v - std::log1p(std::exp(v));
}

}  // namespace patina::posteriordb
