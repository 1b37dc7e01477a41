#include "engine/calibration/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace patina {
namespace {

/// Of one parameter, whose truth lies at each of these places.
std::vector<PhotoOutcome> outcomes_at(const std::vector<double>& places, double sd) {
  std::vector<PhotoOutcome> outcomes;
  for (const double place : places) {
    PhotoOutcome outcome;
    outcome.photo = static_cast<int>(outcomes.size()) + 1;
    outcome.worst_rhat = outcomes.empty() ? 1.2 : 1.01;
    outcome.seconds = 2;
    outcome.simulated = 450;
    outcome.quantities = {{0.5, std::numeric_limits<double>::quiet_NaN(), 1}, {place, sd, 1}};
    outcomes.push_back(outcome);
  }
  return outcomes;
}

std::vector<double> spread(int count, double from, double to) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(from + (to - from) * (i + 0.5) / count);
  return places;
}

const std::vector<std::string> kNames{"lp", "rough"};

TEST(CalibrationReport, CountsConvergenceAndMeansOverPhotos) {
  const CalibrationReport report = report_of(kNames, outcomes_at(spread(100, 0, 1), 0.5));
  EXPECT_EQ(report.photos, 100);
  EXPECT_EQ(report.converged, 99);
  EXPECT_DOUBLE_EQ(report.worst_rhat, 1.2);
  EXPECT_NEAR(report.seconds, 2, 1e-9);
  EXPECT_NEAR(report.quantities[1].coverage.share[2], 0.9, 1e-9);
  EXPECT_TRUE(report.quantities[0].identified);
}

TEST(CalibrationReport, CallsAParameterThatKeepsItsPriorNotIdentified) {
  EXPECT_FALSE(report_of(kNames, outcomes_at(spread(20, 0, 1), 0.95)).quantities[1].identified);
  EXPECT_TRUE(report_of(kNames, outcomes_at(spread(20, 0, 1), 0.85)).quantities[1].identified);
}

TEST(CalibrationReport, ShowsInBoldWhereIntervalsFallShort) {
  const auto page = [](const std::vector<double>& places, double sd) {
    return to_markdown(report_of(kNames, outcomes_at(places, sd)), "bump");
  };
  EXPECT_NE(page(spread(100, 0, 1), 0.5).find("| rough | 0.50 | yes | 50 ± 5"), std::string::npos);
  EXPECT_EQ(page(spread(100, 0, 1), 0.5).find("**90"), std::string::npos);
  EXPECT_NE(page(spread(100, -0.2, 1.2), 0.5).find("| **64 ± 3**"), std::string::npos);
  EXPECT_EQ(page(spread(100, -0.2, 1.2), 0.95).find("| **64"), std::string::npos);
}

}  // namespace
}  // namespace patina
