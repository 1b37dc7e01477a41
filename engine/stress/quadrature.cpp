#include "engine/stress/quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace patina {
namespace {

double density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi); }

/// Of N(0, 1) above z.
double above(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

}  // namespace

Moments moments_of(const std::function<double(double)>& f, const std::function<double(double)>& log_density,
                   double low, double high, int cells) {
  std::vector<double> logs(static_cast<std::size_t>(cells));
  const double width = (high - low) / cells;
  const auto middle = [&](std::size_t i) { return low + (static_cast<double>(i) + 0.5) * width; };
  for (std::size_t i = 0; i < logs.size(); ++i) logs[i] = log_density(middle(i));
  const double highest = std::ranges::max(logs);
  double mass = 0, first = 0, second = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double weight = std::exp(logs[i] - highest), value = f(middle(i));
    mass += weight;
    first += weight * value;
    second += weight * value * value;
  }
  const double mean = first / mass;
  return {mean, std::sqrt(std::max(second / mass - mean * mean, 0.0))};
}

Moments moments(const std::function<double(double)>& log_density, double low, double high, int cells) {
  return moments_of([](double x) { return x; }, log_density, low, high, cells);
}

Moments truncated_normal(double mean, double sd, double low, double high) {
  const double a = (low - mean) / sd, b = (high - mean) / sd;
  const double inside = a > 0 ? above(a) - above(b) : above(-b) - above(-a);
  const double shift = (density(a) - density(b)) / inside;
  const double spread = (a * density(a) - b * density(b)) / inside;
  return {mean + sd * shift, sd * std::sqrt(std::max(1 + spread - shift * shift, 0.0))};
}

}  // namespace patina
