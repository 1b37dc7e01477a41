#include "engine/run/stop_rules.h"

#include <cmath>

#include "engine/run/manifest.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

QuantitySummary quantity(const std::string& name, double bulk, double tail, double rhat, double identified) {
  QuantitySummary q;
  q.name = name;
  q.bulk_ess = bulk;
  q.tail_ess = tail;
  q.rhat = rhat;
  q.sd_over_prior_sd = identified;
  return q;
}

TEST(StopRulesTest, TheWorstFiguresAreThoseOfIdentifiedParametersAndNamed) {
  RunSummary summary;
  summary.quantities = {quantity("lp", 500, 450, 1.002, NAN), quantity("rough", 300, 420, 1.001, 0.2),
                        quantity("light", 900, 410, 1.03, 0.5), quantity("free", 5, 5, 1.09, 0.99),
                        quantity("still", 100, 100, NAN, 0)};
  summary.chains = {{0, 700}, {1, 650}};
  const StopEvidence evidence = stop_evidence(summary);
  EXPECT_EQ(evidence, (StopEvidence{1350, "rough", 300, "light", 1.03}));
  EXPECT_TRUE(is_reached({0, 300, 0}, evidence));
  EXPECT_FALSE(is_reached({0, 301, 0}, evidence));
  EXPECT_TRUE(is_reached({0, 0, 1.03}, evidence));
  EXPECT_FALSE(is_reached({0, 300, 1.02}, evidence));
  EXPECT_FALSE(is_reached({9, 0, 0}, evidence)) << "time is not quality";
  EXPECT_FALSE(is_reached({0, 1, 2}, stop_evidence({}))) << "of no draws nothing is known";
  EXPECT_EQ(in_words({0, 400, 1.01}, evidence),
            "the goal is not reached: the fewest effective draws are 300 (rough; 400 asked for), the largest "
            "R-hat is 1.0300 (light; 1.01 asked for)");
}

TEST(StopRulesTest, AGoalIsSafelyReachedWithSomethingToSpare) {
  const StopRules rules{0, 400, 1.01};
  const auto evidence = [](double ess, double rhat) {
    return StopEvidence{2000, "rough", ess, "light", rhat};
  };
  EXPECT_TRUE(is_reached(rules, evidence(405, 1.0098)));
  EXPECT_FALSE(is_safely_reached(rules, evidence(405, 1.005)));
  EXPECT_FALSE(is_safely_reached(rules, evidence(500, 1.0098)));
  EXPECT_TRUE(is_safely_reached(rules, evidence(425, 1.0085)));
  EXPECT_TRUE(is_safely_reached({0, 400, 0}, evidence(425, 1.5))) << "R-hat is not asked for";
  EXPECT_FALSE(is_safely_reached({9, 0, 0}, evidence(425, 1.0))) << "time is not quality";
}

class StoppedRun : public RunTest {};

TEST_F(StoppedRun, EndsWhenTheGoalIsReachedWithTheEvidenceThatDecidedIt) {
  RunSettings asked = endless();
  asked.summary = "means";
  asked.stop = {0, 60, 1.2};
  const auto run = start(asked);
  std::vector<Draw> draws = draws_to_the_end(*run);
  EXPECT_EQ(run->status().phase, RunPhase::finished) << run->status().message;
  EXPECT_NE(run->status().message.find("the goal is reached: the fewest"), std::string::npos)
      << run->status().message;
  const auto evidence = read_manifest(directory()).evidence;
  ASSERT_TRUE(evidence);
  EXPECT_TRUE(is_reached(asked.stop, *evidence));
  const StopEvidence in_the_end = stop_evidence(summarize_draws(run->table(), draws));
  EXPECT_LE(evidence->draws, in_the_end.draws);
  EXPECT_TRUE(is_reached({0, 0.8 * 60, 1.25}, in_the_end))
      << "of the draws made until the chains heard of it";
  EXPECT_LT(in_the_end.draws, 20'000);
}

TEST_F(StoppedRun, WhoseGoalIsBeyondItsDrawsSaysSo) {
  RunSettings asked = settings();
  asked.stop.ess = 1e6;
  const auto run = start(asked);
  EXPECT_EQ(draws_to_the_end(*run).size(), 2u * (40 + 30));
  EXPECT_EQ(run->status().phase, RunPhase::finished);
  EXPECT_NE(run->status().message.find("60 draws; the goal is not reached: the fewest"), std::string::npos)
      << run->status().message;
}

TEST_F(StoppedRun, EndsWhenItsTimeIsOverWithTheFirstDrawsOfTheWholeRun) {
  draws_to_the_end(*start_run(settings(), photo(), folder_ / "whole"));
  RunSettings asked = settings();
  asked.draws = 1'000'000;
  asked.stop.minutes = 0.05;
  const auto run = start(asked);
  draws_to_the_end(*run);
  EXPECT_EQ(run->status().phase, RunPhase::finished);
  EXPECT_NE(run->status().message.find("its time is over"), std::string::npos) << run->status().message;
  const auto whole = rows_of(folder_ / "whole" / "chain-1.csv"), part = rows_of(directory() / "chain-1.csv");
  ASSERT_GT(part.size(), 40u);
  for (std::size_t i = 0; i < std::min(part.size(), whole.size()); ++i) ASSERT_EQ(part[i], whole[i]) << i;
}

TEST_F(StoppedRun, RefusesRulesThatCannotBe) {
  RunSettings bad = settings();
  bad.stop.rhat = 0.9;
  EXPECT_NE(user_error([&] { start(bad); }).find("R-hat"), std::string::npos);
  bad.stop = {-1, 0, 0};
  EXPECT_NE(user_error([&] { start(bad); }), "");
}

}  // namespace
}  // namespace patina
