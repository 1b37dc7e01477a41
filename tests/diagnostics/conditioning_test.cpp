#include "engine/diagnostics/conditioning.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "engine/diagnostics/density_at.h"
#include "tests/diagnostics/series.h"

namespace patina {
namespace {

/// Draws whose sample covariance is exactly the given one, of mean zero: chance is taken out.
Eigen::MatrixXd draws_with(const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd white = ar1(200, covariance.cols(), 0, 3);
  white = (white.rowwise() - white.colwise().mean()).eval();
  const Eigen::MatrixXd sample = white.transpose() * white / 199.0;
  const Eigen::MatrixXd unit = white * Eigen::MatrixXd(sample.llt().matrixU()).inverse();
  return unit * Eigen::MatrixXd(covariance.llt().matrixU());
}

TEST(Conditioning, of_two_quantities_is_the_regression) {
  const double r = 0.6, sd = 3;
  const Eigen::MatrixXd draws = draws_with((Eigen::Matrix2d() << 1, r * sd, r * sd, sd * sd).finished());
  const auto [shift, narrowing] = condition(draws, {0}, Eigen::VectorXd::Constant(1, 2.0));
  EXPECT_NEAR(shift[1], 2 * r, 1e-9);
  EXPECT_NEAR(narrowing[1], std::sqrt(1 - r * r), 1e-9);
  EXPECT_EQ(shift[0], 0);
}

TEST(Conditioning, of_two_held_ones_is_the_block_formula) {
  Eigen::Matrix3d c;
  c << 2, 0.5, 0.9, 0.5, 1, -0.3, 0.9, -0.3, 1.5;
  const Eigen::Vector2d held(1.5, -0.7);
  const auto [shift, narrowing] = condition(draws_with(c), {0, 1}, held);
  const Eigen::RowVector2d slope = c.block<1, 2>(2, 0) * c.topLeftCorner<2, 2>().inverse();
  EXPECT_NEAR(shift[2], slope.dot(held) / std::sqrt(c(2, 2)), 1e-9);
  EXPECT_NEAR(narrowing[2], std::sqrt(1 - slope.dot(c.block<1, 2>(2, 0)) / c(2, 2)), 1e-9);
}

TEST(Conditioning, a_quantity_that_never_changes_neither_holds_nor_is_moved) {
  Eigen::MatrixXd draws = ar1(100, 3, 0, 5);
  draws.col(1).setConstant(4);
  const auto [shift, narrowing] = condition(draws, {1}, Eigen::VectorXd::Constant(1, 9.0));
  EXPECT_TRUE(shift.isZero());
  EXPECT_TRUE(narrowing.isOnes());
}

/// Draws of the density 2 (1 - x) on [0, 1], through the inverse of its cdf; neighbours correlate.
Eigen::MatrixXd falling(double correlation) {
  return ar1(20000, 4, correlation, 7).unaryExpr([](double z) {
    return 1 - std::sqrt(0.5 * std::erfc(z * M_SQRT1_2));
  });
}

TEST(DensityAt, is_the_density_at_ends_and_inside_within_its_error) {
  for (const double correlation : {0.0, 0.8})
    for (const double point : {0.0, 0.3, 0.7, 1.0}) {
      const auto [value, error] = density_at(falling(correlation), point);
      EXPECT_LT(std::abs(value - 2 * (1 - point)), 4 * error) << point << ", correlation " << correlation;
      EXPECT_LT(error, 0.12);
    }
}

TEST(DensityAt, counts_only_effective_draws) {
  EXPECT_GT(density_at(falling(0.9), 0.5, 0.2).error, 1.5 * density_at(falling(0), 0.5, 0.2).error);
}

}  // namespace
}  // namespace patina
