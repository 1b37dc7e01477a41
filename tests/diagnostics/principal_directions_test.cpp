#include "engine/diagnostics/principal_directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patina {
namespace {

/// x, its near copy in other units, an independent one, and a constant.
Eigen::MatrixXd some_draws() {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd draws(20000, 4);
  for (auto row : draws.rowwise()) {
    const double x = normal(generator);
    row << x, -1000 * (0.8 * x + 0.6 * normal(generator)), normal(generator), 7;
  }
  return draws;
}

TEST(PrincipalDirections, AreThoseOfAKnownCorrelation) {
  const auto directions = principal_directions(some_draws(), 3);
  ASSERT_EQ(directions.size(), 3u);
  // Correlation -0.8: variances 1.8, 1 and 0.2 along (1, -1)/sqrt 2, the third, (1, 1)/sqrt 2.
  const double share[] = {0.6, 1 / 3.0, 0.2 / 3};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(directions[i].share, share[i], 0.01);
  EXPECT_NEAR(std::abs(directions[0].loadings[0]), std::sqrt(0.5), 0.02);
  EXPECT_NEAR(directions[0].loadings[0], -directions[0].loadings[1], 0.03);
  EXPECT_NEAR(directions[1].loadings[2], 1, 0.02);
  for (const auto& direction : directions) {
    EXPECT_NEAR(direction.loadings[3], 0, 1e-12) << "a constant has no part in it";
    EXPECT_NEAR(direction.loadings.norm(), 1, 1e-12);
    EXPECT_GT(direction.loadings.maxCoeff(), -direction.loadings.minCoeff() - 1e-12);
  }
}

TEST(PrincipalDirections, HaveDrawsAlongThemThatDoNotCorrelateAndAddUp) {
  const Eigen::MatrixXd draws = some_draws();
  const auto directions = principal_directions(draws, 9);
  ASSERT_EQ(directions.size(), 3u) << "one quantity never changes";
  Eigen::MatrixXd values(draws.rows(), 3);
  for (int i = 0; i < 3; ++i) values.col(i) = along(directions[i], draws);
  const Eigen::MatrixXd covariance = values.transpose() * values / (draws.rows() - 1.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(covariance(i, i), 3 * directions[i].share, 1e-9);
    for (int j = 0; j < i; ++j) EXPECT_NEAR(covariance(i, j), 0, 1e-9);
  }
}

TEST(PrincipalDirections, OfNothingAreNone) {
  EXPECT_TRUE(principal_directions(Eigen::MatrixXd(0, 3), 3).empty());
  EXPECT_TRUE(principal_directions(Eigen::MatrixXd(9, 0), 3).empty());
  EXPECT_TRUE(principal_directions(Eigen::MatrixXd::Ones(9, 3), 3).empty());
}

}  // namespace
}  // namespace patina
