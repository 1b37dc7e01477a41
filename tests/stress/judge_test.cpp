#include "engine/stress/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patina {
namespace {

Draw draw_of(int chain, double value) {
  Draw draw;
  draw.chain = chain;
  draw.values.continuous = {value};
  return draw;
}

std::vector<Draw> normal_draws(double mean, double sd, int per_chain = 500) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal(mean, sd);
  std::vector<Draw> draws;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < per_chain; ++i) draws.push_back(draw_of(k, normal(generator)));
  return draws;
}

Known known(double mean, double sd) {
  return {"x", [](const ParameterValues& values) { return values.continuous[0]; }, mean, sd};
}

/// What a run of which R-hat and ESS are good says of itself.
Evidence converged() {
  Evidence evidence;
  QuantitySummary good;
  good.rhat = 1.001;
  good.bulk_ess = good.tail_ess = 900;
  evidence.summary.quantities = {good};
  return evidence;
}

TEST(Judge, an_error_is_the_distance_of_the_mean_in_posterior_sds_with_its_own_standard_error) {
  const Error error = worst_error({known(1, 2)}, normal_draws(2, 2));
  EXPECT_NEAR(error.size, 0.5, 4 / std::sqrt(2000.0));
  EXPECT_NEAR(error.mcse, 1 / std::sqrt(2000.0), 0.005);
  EXPECT_EQ(error.name, "x");
}

TEST(Judge, an_sd_that_is_wrong_is_an_error_as_well) {
  const Error error = worst_error({known(2, 1)}, normal_draws(2, 2));
  EXPECT_EQ(error.name, "sd of x");
  EXPECT_NEAR(error.size, std::log(2), 0.08);
}

TEST(Judge, the_worst_of_several_quantities_counts) {
  EXPECT_NEAR(worst_error({known(2, 2), known(8, 2), known(3, 2)}, normal_draws(2, 2)).size, 3, 0.1);
}

TEST(Judge, draws_that_give_no_answer_are_infinitely_wrong) {
  EXPECT_EQ(worst_error({known(0, 1)}, {}).size, INFINITY);
  EXPECT_EQ(worst_error({known(0, 1)}, {draw_of(0, 0)}).size, INFINITY);
  EXPECT_FALSE(worst_error({known(0, 1)}, {draw_of(0, 0), draw_of(0, NAN)}).size <= kWrong);
}

TEST(Judge, a_wrong_answer_that_nothing_speaks_against_is_silent) {
  Evidence evidence = converged();
  evidence.error.size = 0.24;
  EXPECT_EQ(outcome(evidence), Outcome::right);
  evidence.error.size = 0.26;
  EXPECT_EQ(outcome(evidence), Outcome::silent);
  evidence.error.size = NAN;
  EXPECT_EQ(outcome(evidence), Outcome::silent);
}

TEST(Judge, an_alarm_or_a_verdict_that_is_not_good_speaks_against_a_wrong_answer) {
  Evidence evidence = converged();
  evidence.error.size = 1;
  evidence.alarms = {{"noise", "a sentence"}};
  EXPECT_EQ(outcome(evidence), Outcome::alarmed);
  evidence.alarms.clear();
  evidence.summary.quantities[0].rhat = 1.02;
  EXPECT_EQ(outcome(evidence), Outcome::alarmed);
  evidence.is_short = true;
  EXPECT_EQ(outcome(evidence), Outcome::silent) << "of a run too short for R-hat that R-hat is no alarm";
  evidence.refusal = "a sentence";
  EXPECT_EQ(outcome(evidence), Outcome::refused);
}

}  // namespace
}  // namespace patina
