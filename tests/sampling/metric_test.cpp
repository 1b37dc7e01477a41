#include "engine/sampling/metric.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "engine/sampling/rng.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

TEST(Metric, colour_is_a_square_root_of_the_covariance) {
  const Metric metric(some_covariance(5));
  Eigen::MatrixXd root(5, 5);
  for (Eigen::Index i = 0; i < 5; ++i) root.col(i) = metric.colour(Eigen::VectorXd::Unit(5, i));
  EXPECT_TRUE((root * root.transpose()).isApprox(metric.covariance(), 1e-13));
}

TEST(Metric, inverse_norm_undoes_multiply_and_colour) {
  const Metric metric(some_covariance(4));
  const Eigen::VectorXd v = Eigen::Vector4d(1, -2, 0.5, 3);
  EXPECT_NEAR(metric.inverse_norm2(metric.multiply(v)), v.dot(metric.covariance() * v), 1e-12);
  EXPECT_NEAR(metric.inverse_norm2(metric.colour(v)), v.squaredNorm(), 1e-12);
}

TEST(Metric, identity_leaves_vectors_alone) {
  const Metric metric = Metric::identity(3);
  const Eigen::VectorXd v = Eigen::Vector3d(1, 2, 3);
  EXPECT_EQ(metric.multiply(v), v);
  EXPECT_EQ(metric.colour(v), v);
  EXPECT_DOUBLE_EQ(metric.inverse_norm2(v), 14);
}

TEST(Metric, of_no_dimension_is_allowed) {
  EXPECT_EQ(Metric::identity(0).colour(Eigen::VectorXd(0)).size(), 0);
}

TEST(Metric, refuses_what_is_not_a_covariance) {
  Eigen::MatrixXd asymmetric = Eigen::MatrixXd::Identity(2, 2);
  asymmetric(0, 1) = 0.5;
  Eigen::MatrixXd indefinite = Eigen::MatrixXd::Identity(2, 2);
  indefinite(1, 1) = -1;
  Eigen::MatrixXd unknown = Eigen::MatrixXd::Identity(2, 2);
  unknown(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Metric(Eigen::MatrixXd::Zero(2, 3)), std::invalid_argument);
  EXPECT_THROW(Metric(Eigen::MatrixXd::Zero(2, 2)), std::invalid_argument);
  for (const auto& matrix : {asymmetric, indefinite, unknown})
    EXPECT_THROW(Metric{matrix}, std::invalid_argument);
}

TEST(Metric, colours_by_a_factor_of_the_covariance_and_by_its_transpose) {
  const Metric metric(some_covariance(4));
  Rng rng(63);
  const Eigen::VectorXd a = rng.normals(4), b = rng.normals(4);
  EXPECT_NEAR(a.dot(metric.colour(b)), metric.colour_transposed(a).dot(b), 1e-12);
  EXPECT_LT((metric.colour(metric.colour_transposed(a)) - metric.multiply(a)).norm(), 1e-12);
}

TEST(Metric, gives_each_coordinate_the_room_that_the_others_leave_it) {
  const Metric metric(some_covariance(5));
  const Eigen::VectorXd room = metric.conditional_sds();
  for (Eigen::Index i = 0; i < 5; ++i) {
    EXPECT_NEAR(room[i] * room[i], metric.conditional({i})->covariance()(0, 0), 1e-12);
    EXPECT_LT(room[i] * room[i], metric.covariance()(i, i));
  }
}

TEST(MetricKind, has_a_name_for_every_kind_and_refuses_others) {
  EXPECT_EQ(metric_names().size(), 4u);
  for (const std::string& name : metric_names()) EXPECT_NO_THROW(metric_kind(name));
  EXPECT_THROW(metric_kind("low rank"), std::invalid_argument);
}

}  // namespace
}  // namespace patina
