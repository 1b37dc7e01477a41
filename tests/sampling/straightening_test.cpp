#include "engine/sampling/straightening.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
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

Straightening some_map() {
  Straightening::Coefficients coefficients{Eigen::MatrixXd::Zero(5, 4), Eigen::MatrixXd::Zero(5, 4)};
  coefficients.middle.col(0) << 1, -0.5, 2, -1, 0.3;
  coefficients.middle.col(3) << -2, 0.7, -1, 0.5, 0.1;
  coefficients.log_width.col(0) << 0.3, -0.5, 0.5, 1, -0.3;
  coefficients.log_width.col(3) << -1, 0.2, -0.4, 0.3, 0.1;
  return Straightening(1, NaturalSplineBasis(kKnots), coefficients);
}

TEST(Straightening, bends_back_what_it_straightened_and_leaves_the_lead_and_the_unbent) {
  const Straightening map = some_map();
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::VectorXd x = 2 * rng.normals(4), y = map.straighten(x);
    EXPECT_LT((map.bend(y) - x).norm(), 1e-13 * (1 + x.norm() + y.norm()));
    EXPECT_EQ(y[1], x[1]);
    EXPECT_EQ(y[2], x[2]);
    EXPECT_NE(y[0], x[0]);
  }
}

/// d bend / dy by central differences.
Eigen::MatrixXd jacobian(const Straightening& map, const Eigen::VectorXd& y) {
  Eigen::MatrixXd result(y.size(), y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(y.size(), i);
    result.col(i) = (map.bend(y + step) - map.bend(y - step)) / 2e-5;
  }
  return result;
}

TEST(Straightening, has_the_density_that_its_jacobian_asks_for_and_that_densitys_gradient) {
  const Straightening map = some_map();
  const GaussianTarget target(Eigen::Vector4d(1, 0, -1, 0.5), some_covariance(4));
  const auto in_y = [&](const Eigen::VectorXd& y) {
    return map.density_of_y(y, target.evaluate({map.bend(y), {}}));
  };
  Rng rng(2);
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd y = 1.2 * rng.normals(4);
    const Evaluation of_x = target.evaluate({map.bend(y), {}}), of_y = in_y(y);
    EXPECT_NEAR(of_y.log_density - of_x.log_density, std::log(jacobian(map, y).determinant()), 1e-7);
    for (Eigen::Index k = 0; k < 4; ++k) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(4, k);
      const double slope = (in_y(y + step).log_density - in_y(y - step).log_density) / 2e-5;
      EXPECT_NEAR(of_y.gradient[k], slope, 1e-6 * (1 + of_y.gradient.norm()));
    }
    const Evaluation back = map.density_of_x(y, of_y);
    EXPECT_NEAR(back.log_density, of_x.log_density, 1e-12 * (1 + std::abs(of_x.log_density)));
    EXPECT_LT((back.gradient - of_x.gradient).norm(), 1e-12 * (1 + of_y.gradient.norm()));
  }
}

TEST(Straightening, carries_covariances_as_its_jacobian_does_in_the_middle) {
  const Straightening map = some_map();
  const Eigen::MatrixXd covariance = some_covariance(4);
  for (const double lead : {-3.0, -0.5, 0.8, 2.0, 4.0}) {
    const Eigen::MatrixXd bending = jacobian(map, lead * Eigen::Vector4d::Unit(1));
    EXPECT_TRUE(
        map.covariance_in_x(lead, covariance).isApprox(bending * covariance * bending.transpose(), 1e-7));
    EXPECT_TRUE(map.covariance_in_y(lead, map.covariance_in_x(lead, covariance)).isApprox(covariance, 1e-11));
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

TEST(FitStraightening, straightens_a_banana_and_nothing_else) {
  const auto map = fit_straightening(bananas(4, 200));
  ASSERT_TRUE(map);
  EXPECT_EQ(map->lead(), 0);
  double bent = 0, straight = 0;
  for (double a = -2; a <= 2; a += 0.05) {
    const Eigen::VectorXd x = (Eigen::VectorXd(5) << a, a * a, 0, 0, 0).finished();
    const Eigen::VectorXd y = map->straighten(x);
    bent = std::max(bent, std::abs(x[1]));
    straight = std::max(straight, 0.1 * std::abs(y[1]));  // of which the width is 1
    EXPECT_EQ(y.tail(3), x.tail(3)) << "a line was straight already";
  }
  EXPECT_LT(straight, 0.1 * bent);
}

TEST(FitStraightening, finds_none_where_there_is_none_or_too_little_to_see_or_it_may_not_be_used) {
  std::vector<Eigen::MatrixXd> gaussian(4, Eigen::MatrixXd(13, 100));
  Rng rng(4);
  const Metric metric(some_covariance(13));
  for (Eigen::MatrixXd& chain : gaussian)
    for (auto x : chain.colwise()) x = metric.colour(rng.normals(13));
  EXPECT_FALSE(fit_straightening(gaussian));
  EXPECT_FALSE(fit_straightening(bananas(4, 74))) << "fewer than 300 draws";
  EXPECT_TRUE(fit_straightening(bananas(4, 75)));
  // Its first two coordinates are a banana, the other two know nothing of it.
  std::vector<Eigen::MatrixXd> alone;
  for (const Eigen::MatrixXd& chain : bananas(4, 200))
    alone.push_back(chain(std::vector{0, 1, 3, 4}, Eigen::all));
  EXPECT_TRUE(fit_straightening(alone));
  EXPECT_FALSE(fit_straightening(alone, {true, false, false, false})) << "the lead is fixed";
  EXPECT_FALSE(fit_straightening(alone, {false, true, false, false})) << "the bent one is fixed";
  EXPECT_FALSE(fit_straightening(std::vector<Eigen::MatrixXd>(4, Eigen::MatrixXd::Ones(5, 100))))
      << "a stuck chain";
}

/// Draws of a funnel: x0 ~ N(0, 1), x1 ~ N(0, e^x0), the rest N(0, 1).
TEST(FitStraightening, makes_a_funnel_equally_wide) {
  Rng rng(5);
  std::vector<Eigen::MatrixXd> chains(4, Eigen::MatrixXd(4, 400));
  for (Eigen::MatrixXd& chain : chains)
    for (auto x : chain.colwise()) {
      x = rng.normals(4);
      x[1] *= std::exp(0.5 * x[0]);
    }
  const auto map = fit_straightening(chains);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->lead(), 0);
  for (double a = -1.5; a <= 1.5; a += 0.25) {
    const auto width = [&](double y) { return map->bend((Eigen::VectorXd(4) << a, y, 0, 0).finished())[1]; };
    EXPECT_NEAR(std::log((width(1) - width(-1)) / 2), 0.5 * a, 0.25) << a;
  }
}

/// The furthest that the middle of an eighth of the draws is from 0, and its log width from that of 1, along
/// a ridge with a kink, at which it also becomes five times as narrow: worse of both.
double worst_eighth(Eigen::Index draws_per_chain) {
  Rng rng(6);
  std::vector<Eigen::MatrixXd> chains(4, Eigen::MatrixXd(3, draws_per_chain));
  for (Eigen::MatrixXd& chain : chains)
    for (auto x : chain.colwise()) {
      x = rng.normals(3);
      x[1] = x[0] > 0 ? 3 * x[0] + 0.1 * x[1] : -2 * x[0] + 0.5 * x[1];
    }
  const auto map = fit_straightening(chains);
  if (!map || map->lead() != 0) return std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, double>> draws;  // lead, straightened
  for (const Eigen::MatrixXd& chain : chains)
    for (auto x : chain.colwise()) draws.emplace_back(x[0], map->straighten(x)[1]);
  std::ranges::sort(draws);
  const std::size_t eighth = draws.size() / 8;
  double worst = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    double sum = 0, square = 0;
    for (std::size_t k = i * eighth; k < (i + 1) * eighth; ++k) {
      sum += draws[k].second;
      square += draws[k].second * draws[k].second;
    }
    const double n = static_cast<double>(eighth), mean = sum / n;
    worst = std::max({worst, std::abs(mean), std::abs(0.5 * std::log(square / n - mean * mean))});
  }
  return worst;
}

TEST(FitStraightening, follows_a_kink_once_there_are_draws_enough) {
  EXPECT_LT(worst_eighth(1000), 0.5);
  EXPECT_GT(worst_eighth(240), 0.6) << "the control: five knots cut its corner";
}

/// A ridge bent as that of a height and a power whose product is seen where it does not clip: x0 ~ N(0, 1),
/// x1 = max(x0, 0) + N(0, 0.05^2), in 8 dimensions.
FunctionDensity bent_ridge() {
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
  const FunctionDensity target = bent_ridge();
  const auto kernel = make_kernel("hmc", target, 1, 0.3);
  const auto worth = [&](MetricKind metric) {
    const Sample drawn = sample(target, *kernel, {.warmup = 500, .draws = 2000, .metric = metric});
    EXPECT_NEAR(drawn.coordinates[0].mean(), 0, 0.2);
    return std::min(mean_ess(drawn.coordinates[0]), mean_ess(drawn.coordinates[1])) /
           static_cast<double>(drawn.evaluations);
  };
  EXPECT_GT(worth(MetricKind::curved), 3 * worth(MetricKind::dense));
}

TEST(Straightened, energy_is_that_of_the_targets_own_density_whatever_the_map) {
  const FunctionDensity target = bent_ridge();
  const auto walk = make_kernel("mh", target, 1, 0.3), hmc = make_kernel("hmc", target, 1);
  const SampleSettings settings{.warmup = 500, .draws = 200, .metric = MetricKind::curved};
  const Sample walked = sample(target, *walk, settings), travelled = sample(target, *hmc, settings);
  ASSERT_TRUE(walked.frozen.straightening && travelled.frozen.straightening);
  EXPECT_EQ(walked.energy, -walked.log_density) << "there is no momentum";
  const Eigen::ArrayXXd kinetic = travelled.energy + travelled.log_density;
  EXPECT_NEAR(kinetic.mean(), 0.5 * static_cast<double>(target.dimension()), 0.2);
}

}  // namespace
}  // namespace patina
