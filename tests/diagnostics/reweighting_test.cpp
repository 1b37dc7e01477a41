#include "engine/diagnostics/reweighting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/diagnostics/series.h"

namespace patina {
namespace {

constexpr int kDraws = 20000;

Eigen::VectorXd normal_draws(std::uint64_t seed) { return ar1(kDraws, 1, 0, seed).col(0); }

TEST(Reweighting, of_a_normal_distribution_by_a_linear_log_ratio_moves_its_mean_exactly_so) {
  const Eigen::VectorXd x = 3 + 2 * normal_draws(5).array();
  for (const double slope : {-0.4, 0.1, 1.5}) {
    const Reweighting moved = reweight(x, slope * x.array() / 2, kDraws);
    EXPECT_NEAR(moved.mean_shift, slope, 4 * moved.mean_error)
        << "N(m, s^2) times exp(b x) is N(m + b s^2, s^2)";
    EXPECT_NEAR(moved.log_spread, 0, 4 * moved.spread_error);
    EXPECT_LT(moved.mean_error, 0.03);
  }
}

TEST(Reweighting, by_a_quadratic_log_ratio_changes_the_spread) {
  const Eigen::VectorXd x = normal_draws(6);
  constexpr double kPrecision = 0.1;
  const Reweighting narrowed = reweight(x, -kPrecision * x.array().square() / 2, kDraws);
  EXPECT_NEAR(narrowed.log_spread, -std::log(1 + kPrecision) / 2, 4 * narrowed.spread_error + 0.005);
  EXPECT_LT(narrowed.log_spread, -0.04);
  EXPECT_NEAR(narrowed.mean_shift, 0, 4 * narrowed.mean_error);
}

TEST(Reweighting, by_what_the_quantity_has_nothing_to_do_with_changes_nothing) {
  const Reweighting none = reweight(normal_draws(7), normal_draws(8), kDraws);
  EXPECT_NEAR(none.mean_shift, 0, 4 * none.mean_error);
  EXPECT_NEAR(none.log_spread, 0, 4 * none.spread_error);
}

TEST(Reweighting, of_fewer_independent_draws_is_known_less_well) {
  const Eigen::VectorXd x = normal_draws(9);
  EXPECT_NEAR(reweight(x, x, 100).mean_error, reweight(x, x, 400).mean_error * 2, 1e-12);
}

}  // namespace
}  // namespace patina
