#include "engine/calibration/coverage.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

constexpr int kBins = 10;

/// Upper tail of the chi-square law: Q(k / 2, x / 2).
double chi_square_tail(double x, int degrees) { return Eigen::numext::igammac(0.5 * degrees, 0.5 * x); }

double chi_square_of(const std::vector<double>& places) {
  std::array<int, kBins> counts{};
  for (const double place : places)
    ++counts[static_cast<std::size_t>(std::clamp(static_cast<int>(place * kBins), 0, kBins - 1))];
  const double expected = static_cast<double>(places.size()) / kBins;
  double statistic = 0;
  for (const int count : counts) statistic += (count - expected) * (count - expected) / expected;
  return statistic;
}

}  // namespace

double place_among(const Eigen::Ref<const Eigen::MatrixXd>& draws, double truth, Rng& rng) {
  const auto below = static_cast<double>((draws.array() < truth).count());
  const auto equal = static_cast<double>((draws.array() == truth).count());
  return (below + rng.uniform() * (equal + 1)) / (static_cast<double>(draws.size()) + 1);
}

double Coverage::error(std::size_t interval) const {
  return std::sqrt(kIntervals[interval] * (1 - kIntervals[interval]) / count);
}

Coverage coverage(const std::vector<double>& places) {
  Coverage result;
  result.count = static_cast<int>(places.size());
  if (places.empty()) return result;
  for (std::size_t i = 0; i < kIntervals.size(); ++i)
    result.share[i] = static_cast<double>(std::ranges::count_if(
                          places, [&](double p) { return std::abs(2 * p - 1) <= kIntervals[i]; })) /
                      result.count;
  result.chi_square = chi_square_of(places);
  result.uniformity = chi_square_tail(result.chi_square, kBins - 1);
  return result;
}

}  // namespace patina
