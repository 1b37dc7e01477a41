#include "engine/chart/accuracy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/chart/autoregression.h"

namespace patina {
namespace {

constexpr double kRho = 0.6;

/// A normal quantity and a choice of two, the second with probability 0.3.
QuantityDraws some_draws(Eigen::Index draws, Rng& rng, double shift = 0, double scale = 1) {
  const Eigen::MatrixXd x = autoregressive_draws(draws, 4, kRho, rng);
  const Eigen::MatrixXd y = autoregressive_draws(draws, 4, kRho, rng);
  constexpr double kUpper = 0.524400512708041;  // quantile 0.7 of N(0, 1)
  return {{shift + scale * x.array()}, {(y.array() - shift > kUpper).cast<double>()}};
}

const std::vector<std::string> kNames{"x", "choice"};

TEST(Accuracy, error_bars_are_what_errors_scatter_by) {
  constexpr int kPairs = 150;
  Rng rng(3);
  double mean = 0, sd = 0, levels = 0, wasserstein = 0;
  for (int i = 0; i < kPairs; ++i) {
    const GoldStandard gold(some_draws(700, rng), kNames);
    const Accuracy accuracy = compare(some_draws(500, rng), gold, i);
    mean += std::pow(accuracy.mean.value / accuracy.mean.bar, 2) / kPairs;
    sd += std::pow(accuracy.sd.value / accuracy.sd.bar, 2) / kPairs;
    levels += std::pow(accuracy.levels.value / accuracy.levels.bar, 2) / kPairs;
    wasserstein = std::max(wasserstein, accuracy.wasserstein.value / accuracy.wasserstein.bar);
  }
  // The mean square of 150 standard normals has sd 0.115.
  for (const double mean_square : {mean, sd, levels}) EXPECT_NEAR(mean_square, 1, 4 * 0.115);
  EXPECT_LT(wasserstein, 3);
}

TEST(Accuracy, finds_a_shift_a_wrong_width_and_a_wrong_choice_many_bars_above_chance) {
  Rng rng(4);
  const GoldStandard gold(some_draws(4000, rng), kNames);
  const Accuracy shifted = compare(some_draws(4000, rng, 0.5), gold, 1);
  EXPECT_NEAR(shifted.mean.value, 0.5, 4 * shifted.mean.bar);
  EXPECT_GT(shifted.mean.largest_bars, 8);
  EXPECT_GT(shifted.wasserstein.largest_bars, 8);
  EXPECT_GT(shifted.levels.largest_bars, 8);
  EXPECT_EQ(shifted.mean.of, "x");
  EXPECT_EQ(shifted.levels.of, "choice");
  const Accuracy widened = compare(some_draws(4000, rng, 0, 1.3), gold, 1);
  EXPECT_NEAR(widened.sd.value, std::log(1.3), 4 * widened.sd.bar);
  EXPECT_GT(widened.sd.largest_bars, 8);
  EXPECT_LT(widened.mean.largest_bars, 4);
}

TEST(Accuracy, effective_draws_are_the_autoregressions_and_a_chain_that_never_moved_is_worth_one) {
  Rng rng(5);
  const GoldStandard gold(some_draws(4000, rng), kNames);
  QuantityDraws draws = some_draws(4000, rng);
  const double independent_share = (1 - kRho) / (1 + kRho);
  EXPECT_NEAR(compare({draws.continuous, {}}, gold, 1).least_ess / (16000 * independent_share), 1, 0.15);
  draws.continuous.front().setConstant(2);
  const Accuracy stuck = compare(draws, gold, 1);
  EXPECT_EQ(stuck.least_ess, 1);
  EXPECT_EQ(stuck.least_ess_of, "x");
}

TEST(Accuracy, of_too_few_draws_says_nothing) {
  Rng rng(6);
  const GoldStandard gold(some_draws(100, rng), kNames);
  const Accuracy accuracy = compare(some_draws(3, rng), gold, 1);
  EXPECT_TRUE(std::isnan(accuracy.mean.value));
  EXPECT_TRUE(std::isnan(accuracy.least_ess));
}

}  // namespace
}  // namespace patina
