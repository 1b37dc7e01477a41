#include "engine/sampling/valley.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/sampling/function_density.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

double between(const LogDensity& target, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return valley_between(target, state_at(target, {from, {}}), state_at(target, {to, {}}));
}

TEST(ValleyBetween, two_basins_is_as_deep_as_what_parts_them_below_the_lower_one) {
  const FunctionDensity target(2, [](const Position& p) {
    const double u = p.continuous[0];
    return Evaluation{-5 * (u * u - 4) * (u * u - 4) + (u > 1 ? 3 : 0), Eigen::Vector2d::Zero()};
  });
  EXPECT_DOUBLE_EQ(between(target, {-2, 0}, {2, 0}), 80);
  EXPECT_DOUBLE_EQ(between(target, {2, 0}, {-2, 0}), 80);
}

TEST(ValleyBetween, places_of_one_basin_is_none) {
  const FunctionDensity target(2, [](const Position& p) {
    return Evaluation{-50 * p.continuous.squaredNorm(), -100 * p.continuous};
  });
  EXPECT_EQ(between(target, {-0.2, 0.1}, {0.3, 0}), 0);
  EXPECT_EQ(between(target, {-0.2, 0.1}, {-0.2, 0.1}), 0);
}

TEST(ValleyBetween, ends_of_a_bent_ridge_is_what_the_straight_way_cuts_off) {
  const FunctionDensity target(2, [](const Position& p) {
    const double off = p.continuous[1] - p.continuous[0] * p.continuous[0];
    return Evaluation{-10 * off * off, Eigen::Vector2d::Zero()};
  });
  EXPECT_NEAR(between(target, {-1, 1}, {1, 1}), 10, 1e-9);
  EXPECT_NEAR(between(target, {0, 0}, {1, 1}), 10. / 16, 1e-9);
}

TEST(ValleyBetween, what_has_no_density_is_bottomless) {
  const FunctionDensity target(2, [](const Position& p) {
    return Evaluation{std::abs(p.continuous[0]) < 1 ? std::nan("") : 0, Eigen::Vector2d::Zero()};
  });
  EXPECT_EQ(between(target, {-2, 0}, {2, 0}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace patina
