#include "engine/chart/waiting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "tests/chart/autoregression.h"

namespace patina {
namespace {

GoldStandard some_gold() {
  Rng rng(1);
  const Eigen::MatrixXd x = autoregressive_draws(1000, 2, 0, rng);
  const Eigen::MatrixXd y = (2 * autoregressive_draws(1000, 2, 0, rng)).array() + 3;
  return GoldStandard({{x, y}, {}}, {"x", "y"});
}

/// Two matches, then draws of two chains that come at different times.
Trial some_trial() {
  Trial trial;
  trial.search = {{0.3, Eigen::Vector2d(2, 3)}, {0.7, Eigen::Vector2d(0.5, 2)}};
  trial.chains.resize(2);
  Rng rng(2);
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 40; ++i) {
      trial.chains[k].seconds.push_back(1.5 + 0.1 * (k + 1) * i);
      trial.chains[k].values.push_back(Eigen::Vector2d(rng.normal(), 3 + 2 * rng.normal()));
      trial.chains[k].levels.emplace_back(0);
    }
  trial.seconds = 12;
  return trial;
}

/// By its definition, from all draws each time.
WaitingPoint directly(const Trial& trial, const GoldStandard& gold, double seconds) {
  Eigen::Vector2d sum(0, 0);
  long draws = 0;
  for (const TrialChain& chain : trial.chains)
    for (std::size_t i = 0; i < chain.seconds.size(); ++i)
      if (chain.seconds[i] <= seconds) sum += chain.values[i], ++draws;
  Eigen::Vector2d estimate = sum / std::max(draws, 1L);
  if (draws == 0) estimate = trial.search[seconds < trial.search[1].seconds ? 0 : 1].values;
  double error = 0;
  for (int q = 0; q < 2; ++q)
    error = std::max(error, std::abs(estimate[q] - gold.continuous()[q].mean) / gold.continuous()[q].sd);
  return {seconds, error, draws};
}

TEST(WaitingCurve, is_the_match_and_then_the_mean_of_what_has_been_drawn) {
  const GoldStandard gold = some_gold();
  const Trial trial = some_trial();
  const std::vector<WaitingPoint> curve = waiting_curve(trial, gold);
  ASSERT_GT(curve.size(), 10u);
  EXPECT_GE(curve.front().seconds, 0.3) << "nothing before the first match";
  EXPECT_GE(curve.back().seconds, 12) << "to the trial's end";
  EXPECT_LT(curve[curve.size() - 2].seconds, 12);
  EXPECT_EQ(curve.front().draws, 0);
  EXPECT_EQ(curve.back().draws, 80);
  for (const WaitingPoint& point : curve) {
    const WaitingPoint expected = directly(trial, gold, point.seconds);
    EXPECT_EQ(point.draws, expected.draws) << point.seconds;
    EXPECT_NEAR(point.error, expected.error, 1e-12) << point.seconds;
  }
}

TEST(WaitingCurve, of_a_trial_that_is_over_in_a_moment_has_its_end) {
  Trial trial = some_trial();
  for (TrialChain& chain : trial.chains) std::ranges::fill(chain.seconds, 0.85);  // between two of the times
  trial.search.clear();
  trial.seconds = 0.9;
  const std::vector<WaitingPoint> curve = waiting_curve(trial, some_gold());
  ASSERT_EQ(curve.size(), 1u);
  EXPECT_EQ(curve.front().draws, 80);
}

TEST(WaitingCurve, of_repeats_is_read_back_and_has_a_median_where_most_of_them_are) {
  const std::vector<WaitingCurve> curves{{"a", 1, {{1, 0.5, 0}, {2, 0.4, 10}, {4, 0.1, 20}}},
                                         {"b", 1, {{1, 9, 0}}},
                                         {"a", 2, {{1, 0.7, 0}, {2, 0.2, 30}}},
                                         {"a", 3, {{1, 0.6, 0}}}};
  EXPECT_EQ(waiting_curves(waiting_table(curves)), curves);
  const std::vector<WaitingPoint> median = median_curve(curves, "a");
  ASSERT_EQ(median.size(), 2u) << "one repeat of three got to 4 s";
  EXPECT_EQ(median[0], (WaitingPoint{1, 0.6, 0}));
  EXPECT_NEAR(median[1].error, 0.3, 1e-12);
  EXPECT_EQ(median[1].draws, 20);
  EXPECT_THROW(waiting_curves({{}, {"a"}, {}}), UserError);
}

}  // namespace
}  // namespace patina
