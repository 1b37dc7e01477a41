#include "engine/calibration/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

constexpr int kDataSets = 400, kDraws = 199;

/// Places of truths u ~ N(0, 1), each seen once with an error of sd 1, among exact draws of posteriors that
/// take that sd for `believed`.
std::vector<double> places(double believed) {
  Rng rng(1);
  std::vector<double> places;
  const double precision = 1 + 1 / (believed * believed);
  for (int i = 0; i < kDataSets; ++i) {
    const double truth = rng.normal(), seen = truth + rng.normal();
    const double mean = seen / (believed * believed) / precision;
    const Eigen::VectorXd draws = mean + rng.normals(kDraws).array() / std::sqrt(precision);
    places.push_back(place_among(draws, truth, rng));
  }
  return places;
}

TEST(Coverage, OfAnExactPosteriorIsWhatTheIntervalsPromise) {
  const Coverage exact = coverage(places(1));
  EXPECT_EQ(exact.count, kDataSets);
  for (std::size_t i = 0; i < kIntervals.size(); ++i)
    EXPECT_NEAR(exact.share[i], kIntervals[i], 4 * exact.error(i));
  EXPECT_GT(exact.uniformity, 1e-3);
}

TEST(Coverage, OfAnOverconfidentPosteriorFallsShort) {
  const Coverage sure = coverage(places(0.5));
  EXPECT_LT(sure.share[2], 0.9 - 4 * sure.error(2));
  EXPECT_LT(sure.uniformity, 1e-6);
}

TEST(Coverage, UniformityIsTheUpperTailOfChiSquareWithNineDegrees) {
  // 100 places, 28 in the first of ten bins and 8 in each other: chi-square 36; R: pchisq(36, 9, lower = F).
  std::vector<double> places(28, 0.05);
  for (int bin = 1; bin < 10; ++bin) places.insert(places.end(), 8, 0.1 * bin + 0.05);
  EXPECT_NEAR(coverage(places).uniformity, 3.96466e-05, 1e-9);
}

TEST(PlaceAmong, SharesTiesEvenly) {
  Rng rng(2);
  const Eigen::VectorXd same = Eigen::VectorXd::Zero(9);
  double sum = 0;
  for (int i = 0; i < 2000; ++i) sum += place_among(same, 0, rng);
  EXPECT_NEAR(sum / 2000, 0.5, 5 / std::sqrt(12.0 * 2000));
  EXPECT_GT(place_among(same, 1, rng), 0.9);
}

}  // namespace
}  // namespace patina
