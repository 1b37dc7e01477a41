#include "engine/calibration/overall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/sampling/rng.h"

namespace patina {
namespace {

QuantityCoverage parameter(const std::vector<double>& places, bool identified = true) {
  return {"rough", identified ? 0.5 : 0.95, identified, coverage(places)};
}

/// Places of a posterior whose sds are so many times the right ones: uniform where that is 1.
std::vector<double> places(Rng& rng, int photos, double times) {
  std::vector<double> made;
  for (int i = 0; i < photos; ++i)
    made.push_back(0.5 + 0.5 * std::erf(rng.normal() / times / std::sqrt(2.0)));
  return made;
}

CalibrationReport study(Rng& rng, int parameters, double times) {
  CalibrationReport report;
  for (int i = 0; i < parameters; ++i) report.quantities.push_back(parameter(places(rng, 100, times)));
  return report;
}

TEST(OverallCoverage, ScattersAsChanceHasItWhereIntervalsAreRight) {
  Rng rng(1, 0);
  const OverallCoverage right = overall_coverage({study(rng, 200, 1), study(rng, 200, 1)});
  EXPECT_EQ(right.parameters, 400);
  const double error = 1 / std::sqrt(2.0 * right.parameters);  // of a root mean square, relative
  EXPECT_NEAR(right.scatter / right.scatter_by_chance, 1, 4 * error);
  const double p = right.outside_by_chance / right.parameters;
  EXPECT_NEAR(right.outside, right.outside_by_chance, 4 * std::sqrt(right.parameters * p * (1 - p)));
  for (std::size_t i = 0; i < kIntervals.size(); ++i) EXPECT_NEAR(right.share[i], kIntervals[i], 0.01);
}

TEST(OverallCoverage, ScattersMoreWhereSomeAreTooNarrowAndOthersTooWide) {
  Rng rng(2, 0);
  const OverallCoverage mixed = overall_coverage({study(rng, 100, 0.8), study(rng, 100, 1.5)});
  EXPECT_NEAR(mixed.share[2], 0.9, 0.03) << "which the mean does not show";
  EXPECT_GT(mixed.scatter, 2 * mixed.scatter_by_chance);
  EXPECT_GT(mixed.outside, 4 * mixed.outside_by_chance);
}

TEST(OverallCoverage, IsOfIdentifiedParametersAlone) {
  Rng rng(3, 0);
  CalibrationReport report = study(rng, 3, 1);
  report.quantities.push_back(parameter({0.99, 0.99, 0.99}, false));
  QuantityCoverage lp = parameter({0.99, 0.99, 0.99});
  lp.name = "lp", lp.sd_over_prior_sd = std::numeric_limits<double>::quiet_NaN();
  report.quantities.push_back(lp);
  EXPECT_EQ(overall_coverage({report}).parameters, 3);
  EXPECT_EQ(to_markdown(overall_coverage({})), "");
}

TEST(OverallCoverage, ExpectsOutsideWhatTheBinomialLawHasThere) {
  // Of 20 photos, 17, 18 and 19 are within 85 to 95 %: 0.19012 + 0.28518 + 0.27017 of 0.9's law.
  CalibrationReport report;
  report.quantities = {parameter(std::vector<double>(20, 0.5))};
  const OverallCoverage all_held = overall_coverage({report});
  EXPECT_NEAR(all_held.outside_by_chance, 1 - 0.19012 - 0.28518 - 0.27017, 1e-4);
  EXPECT_EQ(all_held.outside, 1);
}

}  // namespace
}  // namespace patina
