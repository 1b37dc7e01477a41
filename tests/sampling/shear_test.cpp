#include "engine/sampling/shear.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/rng.h"
#include "engine/sampling/sample.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

const Eigen::VectorXd kKnots = (Eigen::VectorXd(5) << -2, -1, 0.5, 1, 3).finished();

TEST(NaturalSpline, has_the_slopes_of_its_values) {
  const NaturalSplineBasis basis(kKnots);
  for (const double x : {-3.0, -1.5, 0.0, 0.7, 2.0, 5.0}) {
    const Eigen::VectorXd difference = (basis.values(x + 1e-5) - basis.values(x - 1e-5)) / 2e-5;
    EXPECT_LT((difference - basis.slopes(x)).cwiseAbs().maxCoeff(), 1e-8) << x;
  }
}

TEST(NaturalSpline, is_straight_beyond_its_outer_knots_and_bends_between) {
  const NaturalSplineBasis basis(kKnots);
  const auto bend = [&](double x) { return (basis.slopes(x + 0.1) - basis.slopes(x)).cwiseAbs().maxCoeff(); };
  for (const double x : {-9.0, -2.1, 3.0, 7.0}) EXPECT_LT(bend(x), 1e-12) << x;
  EXPECT_GT(bend(0), 1e-2);
}

Shear some_shear() {
  Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(5, 4);
  coefficients.col(0) << 1, -0.5, 2, -1, 0.3;
  coefficients.col(3) << -2, 0.7, -1, 0.5, 0.1;
  return Shear(1, NaturalSplineBasis(kKnots), coefficients);
}

TEST(Shear, bends_back_what_it_straightened_and_leaves_the_lead_and_the_unbent) {
  const Shear shear = some_shear();
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::VectorXd x = 2 * rng.normals(4), y = shear.straighten(x);
    EXPECT_LT((shear.bend(y) - x).norm(), 1e-14 * (1 + x.norm() + y.norm()));
    EXPECT_EQ(y[1], x[1]);
    EXPECT_EQ(y[2], x[2]);
    EXPECT_NE(y[0], x[0]);
  }
}

/// d straighten / dx by central differences.
Eigen::MatrixXd jacobian(const Shear& shear, const Eigen::VectorXd& x) {
  Eigen::MatrixXd result(x.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(x.size(), i);
    result.col(i) = (shear.straighten(x + step) - shear.straighten(x - step)) / 2e-5;
  }
  return result;
}

TEST(Shear, keeps_volumes_and_pulls_gradients_and_covariances_as_its_jacobian_does) {
  const Shear shear = some_shear();
  Rng rng(2);
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd x = 2 * rng.normals(4), gradient = rng.normals(4);
    const Eigen::MatrixXd straightening = jacobian(shear, x);
    EXPECT_NEAR(straightening.determinant(), 1, 1e-8);
    const Eigen::VectorXd in_y = shear.gradient_in_y(x[1], gradient);
    EXPECT_LT((straightening.transpose() * in_y - gradient).norm(), 1e-7 * in_y.norm());
    EXPECT_LT((shear.gradient_in_x(x[1], in_y) - gradient).norm(), 1e-13 * in_y.norm());
    const Eigen::MatrixXd covariance = some_covariance(4);
    const Eigen::MatrixXd covariance_in_y = shear.covariance_in_y(x[1], covariance);
    EXPECT_TRUE(covariance_in_y.isApprox(straightening * covariance * straightening.transpose(), 1e-7));
    EXPECT_TRUE(shear.covariance_in_x(x[1], covariance_in_y).isApprox(covariance, 1e-11));
  }
}

/// Draws of a banana: x0 ~ N(0, 1), x1 = x0^2 + N(0, 0.1^2), x2 ~ N(x0, 1), the rest N(0, 1).
std::vector<Eigen::MatrixXd> bananas(int chains, int draws) {
  Rng rng(3);
  std::vector<Eigen::MatrixXd> result(chains, Eigen::MatrixXd(5, draws));
  for (Eigen::MatrixXd& chain : result)
    for (auto x : chain.colwise()) {
      x = rng.normals(5);
      x[1] = x[0] * x[0] + 0.1 * x[1];
      x[2] += x[0];
    }
  return result;
}

TEST(FitShear, straightens_a_banana_and_nothing_else) {
  const auto shear = fit_shear(bananas(4, 200));
  ASSERT_TRUE(shear);
  EXPECT_EQ(shear->lead(), 0);
  double bent = 0, straight = 0;
  for (double a = -2; a <= 2; a += 0.05) {
    const Eigen::VectorXd x = (Eigen::VectorXd(5) << a, a * a, 0, 0, 0).finished();
    const Eigen::VectorXd y = shear->straighten(x);
    bent = std::max(bent, std::abs(x[1]));
    straight = std::max(straight, std::abs(y[1]));
    EXPECT_EQ(y.tail(3), x.tail(3)) << "a line was straight already";
  }
  EXPECT_LT(straight, 0.1 * bent);
}

TEST(FitShear, finds_none_where_there_is_none_or_too_little_to_see_or_it_may_not_be_used) {
  std::vector<Eigen::MatrixXd> gaussian(4, Eigen::MatrixXd(13, 100));
  Rng rng(4);
  const Metric metric(some_covariance(13));
  for (Eigen::MatrixXd& chain : gaussian)
    for (auto x : chain.colwise()) x = metric.colour(rng.normals(13));
  EXPECT_FALSE(fit_shear(gaussian));
  EXPECT_FALSE(fit_shear(bananas(4, 74))) << "fewer than 300 draws";
  EXPECT_TRUE(fit_shear(bananas(4, 75)));
  EXPECT_FALSE(fit_shear(bananas(4, 200), {true, false, false, false, false})) << "the lead is fixed";
  EXPECT_FALSE(fit_shear(bananas(4, 200), {false, true, false, false, false})) << "the bent one is fixed";
  EXPECT_FALSE(fit_shear(std::vector<Eigen::MatrixXd>(4, Eigen::MatrixXd::Ones(5, 100)))) << "a stuck chain";
}

/// A ridge bent as that of a height and a power whose product is seen where it does not clip: x0 ~ N(0, 1),
/// x1 = max(x0, 0) + N(0, 0.05^2), in 8 dimensions.
FunctionTarget bent_ridge() {
  return {8, [](const Position& position) {
            const Eigen::VectorXd& x = position.continuous;
            const double sharp = 10, soft_max = std::log1p(std::exp(sharp * x[0])) / sharp;
            const double slope = 1 / (1 + std::exp(-sharp * x[0]));
            const double off = (x[1] - soft_max) / 0.05;
            Evaluation evaluation{-0.5 * (x[0] * x[0] + off * off + x.tail(6).squaredNorm()), -x};
            evaluation.gradient[1] = -off / 0.05;
            evaluation.gradient[0] += off / 0.05 * slope;
            return evaluation;
          }};
}

TEST(Warmup, that_straightens_a_bent_ridge_makes_an_evaluation_worth_several) {
  const FunctionTarget target = bent_ridge();
  const auto kernel = make_kernel("hmc", target, 1, 0.3);
  const auto worth = [&](MetricKind metric) {
    const Sample drawn = sample(target, *kernel, {.warmup = 500, .draws = 2000, .metric = metric});
    EXPECT_NEAR(drawn.coordinates[0].mean(), 0, 0.2);
    return std::min(mean_ess(drawn.coordinates[0]), mean_ess(drawn.coordinates[1])) /
           static_cast<double>(drawn.evaluations);
  };
  EXPECT_GT(worth(MetricKind::curved), 3 * worth(MetricKind::dense));
}

}  // namespace
}  // namespace patina
