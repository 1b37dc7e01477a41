#include "engine/posterior/log_variances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/sampling/rng.h"

namespace patina {
namespace {

constexpr Eigen::Index kPhotos = 4000;

/// Normal errors with log variance c + s v.
Eigen::VectorXd errors_of(double c, const Eigen::Vector2d& s, const Eigen::MatrixXd& inputs, Rng& rng) {
  const Eigen::ArrayXd log_variances = c + (inputs.transpose() * s).array();
  return (rng.normals(inputs.cols()).array() * (0.5 * log_variances).exp()).matrix();
}

Eigen::MatrixXd inputs_of(Rng& rng) {
  Eigen::MatrixXd inputs(2, kPhotos);
  for (Eigen::Index i = 0; i < kPhotos; ++i) inputs.col(i) = rng.normals(2);
  return inputs;
}

TEST(LogVariances, are_found_with_the_slopes_that_errors_were_drawn_with) {
  Rng rng(1);
  const Eigen::MatrixXd inputs = inputs_of(rng);
  const Eigen::Vector2d slopes(0.8, -0.5);
  const Eigen::VectorXd found = fit_log_variance(errors_of(-3, slopes, inputs, rng), inputs);
  const double error = std::sqrt(2.0 / kPhotos);  // of each, by Fisher's information
  EXPECT_NEAR(found[0], -3, 5 * error);
  EXPECT_NEAR(found[1], 0.8, 5 * error + 0.01) << "the prior about no change pulls a little";
  EXPECT_NEAR(found[2], -0.5, 5 * error + 0.01);
}

TEST(LogVariances, have_no_slope_where_errors_are_alike) {
  Rng rng(2);
  const Eigen::MatrixXd inputs = inputs_of(rng);
  const Eigen::VectorXd found = fit_log_variance(errors_of(1, {0, 0}, inputs, rng), inputs);
  EXPECT_NEAR(found[0], 1, 0.12);
  EXPECT_LT(found.tail(2).norm(), 0.12);
}

}  // namespace
}  // namespace patina
