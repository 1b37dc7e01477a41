#include "engine/sampling/optimizer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/sampling/targets.h"

namespace patina {
namespace {

/// Minus Rosenbrock's valley (1960): a curved ridge with its top at (1, 1).
FunctionDensity rosenbrock() {
  return {2, [](const Position& position) {
            const double x = position.continuous[0], y = position.continuous[1], bend = y - x * x;
            return Evaluation{-(100 * bend * bend + (1 - x) * (1 - x)),
                              Eigen::Vector2d(400 * x * bend + 2 * (1 - x), -200 * bend)};
          }};
}

OptimizerSettings precise() {
  OptimizerSettings settings;
  settings.gradient_tolerance = 1e-8;
  settings.value_tolerance = 0;
  settings.max_iterations = 500;
  return settings;
}

TEST(Maximize, follows_rosenbrocks_ridge_to_its_top) {
  const OptimizerResult result = maximize(rosenbrock(), {Eigen::Vector2d(-1.2, 1), {}}, precise());
  EXPECT_NEAR(result.position.continuous[0], 1, 1e-6);
  EXPECT_NEAR(result.position.continuous[1], 1, 1e-6);
  EXPECT_EQ(result.stopped_because, "the gradient vanished");
  EXPECT_LT(result.evaluations, 120);
}

TEST(Maximize, steps_back_from_where_there_is_no_density) {
  // log x - 10 x on x > 0 has its top at 0.1, a tenth of the first step's length away from nothing.
  const FunctionDensity gamma(1, [](const Position& position) {
    const double x = position.continuous[0];
    if (x <= 0) return Evaluation{-std::numeric_limits<double>::infinity(), Eigen::VectorXd::Zero(1)};
    return Evaluation{std::log(x) - 10 * x, Eigen::VectorXd::Constant(1, 1 / x - 10)};
  });
  for (const double start : {1e-3, 0.5, 3.0}) {
    const OptimizerResult result = maximize(gamma, {Eigen::VectorXd::Constant(1, start), {}}, precise());
    EXPECT_NEAR(result.position.continuous[0], 0.1, 1e-6) << "from " << start;
  }
}

TEST(Maximize, returns_the_start_where_that_has_no_density) {
  const FunctionDensity nowhere(2, [](const Position&) {
    return Evaluation{std::numeric_limits<double>::quiet_NaN(), Eigen::VectorXd::Ones(2)};
  });
  const OptimizerResult result = maximize(nowhere, {Eigen::Vector2d(1, 2), {}});
  EXPECT_EQ(result.position.continuous, Eigen::Vector2d(1, 2));
  EXPECT_EQ(result.evaluation.log_density, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.stopped_because, "the start has no density");
}

TEST(Maximize, never_returns_a_point_worse_than_the_start_even_if_the_gradient_lies) {
  const FunctionDensity liar(2, [](const Position& position) {
    return Evaluation{-position.continuous.squaredNorm(), 2 * position.continuous};
  });
  const Eigen::Vector2d start(1, 1);
  const OptimizerResult result = maximize(liar, {start, {}});
  EXPECT_GE(result.evaluation.log_density, -2);
  EXPECT_EQ(result.position.continuous, start);
}

TEST(Maximize, gives_up_half_way_where_it_is_still_below_what_is_hopeless) {
  OptimizerSettings settings;
  settings.max_iterations = 20;
  const Position start{Eigen::Vector2d(-1.2, 1), {}};
  const OptimizerResult all = maximize(rosenbrock(), start, settings);
  settings.max_iterations = 10;
  const OptimizerResult half = maximize(rosenbrock(), start, settings);
  ASSERT_LT(half.evaluation.log_density, all.evaluation.log_density);
  settings.max_iterations = 20;
  settings.hopeless = half.evaluation.log_density + 1e-6;
  const OptimizerResult given_up = maximize(rosenbrock(), start, settings);
  EXPECT_EQ(given_up.position.continuous, half.position.continuous);
  EXPECT_EQ(given_up.stopped_because, "half of the iterations led hardly anywhere");
  settings.hopeless = half.evaluation.log_density - 1e-6;
  EXPECT_EQ(maximize(rosenbrock(), start, settings).position.continuous, all.position.continuous);
}

TEST(Maximize, reports_the_evaluation_of_the_point_it_returns) {
  const FunctionDensity target = rosenbrock();
  OptimizerSettings settings;
  settings.max_iterations = 7;
  const OptimizerResult result = maximize(target, {Eigen::Vector2d(-1.2, 1), {}}, settings);
  const Evaluation fresh = target.evaluate(result.position);
  EXPECT_EQ(fresh.log_density, result.evaluation.log_density);
  EXPECT_EQ(fresh.gradient, result.evaluation.gradient);
  EXPECT_EQ(result.stopped_because, "the limit of iterations was reached");
}

TEST(Maximize, stops_when_asked_to) {
  OptimizerSettings settings = precise();
  int asked = 0;
  settings.stop_requested = [&] { return ++asked == 3; };
  const OptimizerResult result = maximize(rosenbrock(), {Eigen::Vector2d(-1.2, 1), {}}, settings);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(result.stopped_because, "a stop was requested");
}

TEST(Maximize, stops_when_five_iterations_gained_too_little) {
  OptimizerSettings settings = precise();
  settings.value_tolerance = 1e9;
  const OptimizerResult result = maximize(rosenbrock(), {Eigen::Vector2d(-1.2, 1), {}}, settings);
  EXPECT_EQ(result.stopped_because, "the value no longer improves");
}

TEST(Maximize, lets_what_a_target_throws_pass) {
  int calls = 0;
  const FunctionDensity target(1, [&](const Position& position) {
    if (++calls == 3) throw std::runtime_error("no device");
    return Evaluation{-std::pow(position.continuous[0] - 9, 4),
                      Eigen::VectorXd::Constant(1, -4 * std::pow(position.continuous[0] - 9, 3))};
  });
  EXPECT_THROW(maximize(target, {Eigen::VectorXd::Zero(1), {}}), std::runtime_error);
  EXPECT_EQ(calls, 3) << "the target was asked again after it had thrown";
}

TEST(Maximize, keeps_discrete_coordinates_and_copes_with_none_continuous) {
  const FunctionDensity levels(0,
                               [](const Position& p) {
                                 return Evaluation{1.0 * p.discrete[0], Eigen::VectorXd(0)};
                               },
                               {4});
  const OptimizerResult result = maximize(levels, {Eigen::VectorXd(0), Eigen::VectorXi::Constant(1, 2)});
  EXPECT_EQ(result.position.discrete[0], 2);
  EXPECT_EQ(result.evaluation.log_density, 2);
}

TEST(Maximize, holds_jagged_coordinates) {
  const JaggedTarget target(Eigen::Vector2d(1, 2), Eigen::Matrix2d::Identity());
  const OptimizerResult found = maximize(target, {Eigen::Vector2d(0.3, 0), {}});
  EXPECT_EQ(found.position.continuous[0], 0.3);
  EXPECT_NEAR(found.position.continuous[1], 2, 1e-3);
}

}  // namespace
}  // namespace patina
