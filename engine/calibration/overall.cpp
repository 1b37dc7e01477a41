#include "engine/calibration/overall.h"

#include <cmath>

#include "engine/format.h"

namespace patina {
namespace {

constexpr double kPromise = 0.9;

/// That a count of independent events, each of this probability, is no share that satisfies.
double probability_outside(int count, double probability) {
  double inside = 0;
  for (int held = 0; held <= count; ++held)
    if (is_covered(static_cast<double>(held) / count))
      inside +=
          std::exp(std::lgamma(count + 1.0) - std::lgamma(held + 1.0) - std::lgamma(count - held + 1.0) +
                   held * std::log(probability) + (count - held) * std::log1p(-probability));
  return 1 - inside;
}

void add(const Coverage& coverage, OverallCoverage& sums) {
  ++sums.parameters;
  for (std::size_t i = 0; i < kIntervals.size(); ++i) {
    sums.share[i] += coverage.share[i];
    if (kIntervals[i] != kPromise) continue;
    sums.scatter += std::pow(coverage.share[i] - kPromise, 2);
    sums.scatter_by_chance += std::pow(coverage.error(i), 2);
    sums.outside += !is_covered(coverage.share[i]);
    sums.outside_by_chance += probability_outside(coverage.count, kPromise);
  }
}

}  // namespace

OverallCoverage overall_coverage(const std::vector<CalibrationReport>& reports) {
  OverallCoverage overall;
  for (const CalibrationReport& report : reports)
    for (const QuantityCoverage& quantity : report.quantities)
      if (quantity.is_parameter() && quantity.identified) add(quantity.coverage, overall);
  if (overall.parameters == 0) return overall;
  for (double& share : overall.share) share /= overall.parameters;
  overall.scatter = std::sqrt(overall.scatter / overall.parameters);
  overall.scatter_by_chance = std::sqrt(overall.scatter_by_chance / overall.parameters);
  return overall;
}

std::string to_markdown(const OverallCoverage& overall) {
  if (overall.parameters == 0) return "";
  std::string text = format("## All together\n\nOf the %d identified parameters", overall.parameters);
  for (std::size_t i = 0; i < kIntervals.size(); ++i)
    text += format(i == 0 ? " %.0f %% intervals hold the truth %.1f %%" : ", %.0f %% ones %.1f %%",
                   100 * kIntervals[i], 100 * overall.share[i]);
  text += format(
      " of the time.\nThe 90 %% ones are off by %.1f points (root mean square), where chance alone, "
      "of so many photos, is off by %.1f;\n%d lie outside 85 to 95 %%, where chance puts %.1f.\n",
      100 * overall.scatter, 100 * overall.scatter_by_chance, overall.outside, overall.outside_by_chance);
  return text;
}

}  // namespace patina
