#include <gtest/gtest.h>

#include "gui/run_outlook.h"

namespace patina {
namespace {

/// Four chains that have made so many steps each, of 1000 of warm-up and 5000 after it, 100 a second
/// together.
class RunOutlookTest : public ::testing::Test {
 protected:
  RunOutlookTest() {
    settings_.chains = 4;
    settings_.warmup = 1000;
    settings_.draws = 5000;
    settings_.stop = {.minutes = 0, .ess = 0, .rhat = 0};
    status_.draws_per_second = 100;
    reach(RunPhase::sampling, 2000);
  }

  void reach(RunPhase phase, std::int64_t steps) {
    status_.phase = phase;
    status_.chains.assign(4, {});
    for (ChainStatus& chain : status_.chains) chain.iteration = steps;
  }

  RunOutlook outlook(std::optional<double> spent = std::nullopt) const {
    return run_outlook(status_, settings_, evidence_, spent);
  }

  RunSettings settings_;
  RunStatus status_;
  std::optional<StopEvidence> evidence_;
};

using End = RunOutlook::End;

TEST_F(RunOutlookTest, WithoutRulesARunEndsWhenItsSlowestChainHasMadeAllDraws) {
  EXPECT_DOUBLE_EQ(outlook().seconds.value(), 4 * 4000 / 100.0);
  EXPECT_EQ(outlook().end, End::draws);
  EXPECT_FALSE(outlook().at_most);
  EXPECT_FLOAT_EQ(outlook().done, 0.2f);
  status_.chains[2].iteration = 1500;
  EXPECT_DOUBLE_EQ(outlook().seconds.value(), 4 * 4500 / 100.0);
}

TEST_F(RunOutlookTest, TheRuleThatIsNearestEndsTheRun) {
  settings_.stop.minutes = 3;
  EXPECT_DOUBLE_EQ(outlook(100).seconds.value(), 80);
  EXPECT_EQ(outlook(100).end, End::time);
  EXPECT_FLOAT_EQ(outlook(100).done, static_cast<float>(100.0 / 180));
  EXPECT_EQ(outlook(5).end, End::draws);
  EXPECT_EQ(outlook().end, End::draws) << "of another program's run the time is not known";
  EXPECT_DOUBLE_EQ(outlook(1000).seconds.value(), 0) << "the run notices within a moment";
}

TEST_F(RunOutlookTest, EffectiveDrawsGrowWithTheDraws) {
  settings_.stop.ess = 400;
  evidence_ = StopEvidence{4000, "rough", 200, "rough", 1.002};
  // Twice as many draws: another 1000 steps of each of four chains.
  EXPECT_DOUBLE_EQ(outlook().seconds.value(), 40);
  EXPECT_EQ(outlook().end, End::goal);
  EXPECT_FLOAT_EQ(outlook().done, 0.5f);
  reach(RunPhase::sampling, 2500);  // since then, the chains have gone on
  EXPECT_DOUBLE_EQ(outlook().seconds.value(), 20);
}

TEST_F(RunOutlookTest, TheExcessOfRhatFallsAsTheDrawsGrow) {
  settings_.stop = {.minutes = 0, .ess = 400, .rhat = 1.01};
  evidence_ = StopEvidence{4000, "rough", 390, "light", 1.03};
  EXPECT_NEAR(outlook().seconds.value(), 2 * 4000 / 100.0, 1e-9) << "three times as many draws";
  EXPECT_EQ(outlook().end, End::goal);
}

TEST_F(RunOutlookTest, NoGuessIsMadeFromChainsThatHaveNotFoundEachOther) {
  settings_.stop = {.minutes = 9, .ess = 400, .rhat = 1.01};
  EXPECT_TRUE(outlook(60).at_most) << "nothing has been judged";
  evidence_ = StopEvidence{4000, "rough", 200, "light", 1.2};
  EXPECT_TRUE(outlook(60).at_most) << "the chains lie apart";
  evidence_ = StopEvidence{4000, "rough", 8, "light", 1.02};
  EXPECT_TRUE(outlook(60).at_most) << "eight effective draws tell nothing";
  EXPECT_DOUBLE_EQ(outlook(60).seconds.value(), 160) << "all draws are made before nine minutes are over";
  evidence_ = StopEvidence{4000, "rough", 200, "light", 1.02};
  EXPECT_FALSE(outlook(60).at_most);
}

TEST_F(RunOutlookTest, NothingIsKnownOfWhatDoesNotMove) {
  status_.draws_per_second = 0;
  EXPECT_FALSE(outlook().seconds);
  EXPECT_EQ(outlook_text(outlook()), "How long it takes shows once draws come");
}

TEST_F(RunOutlookTest, OfWarmUpItsEndIsKnownAndOfTheSearchOnlyTheLimit) {
  settings_.stop.minutes = 9;
  reach(RunPhase::warming_up, 400);
  EXPECT_EQ(outlook(10).end, End::warmup);
  EXPECT_DOUBLE_EQ(outlook(10).seconds.value(), 4 * 600 / 100.0);
  EXPECT_FLOAT_EQ(outlook(10).done, 0.4f);
  EXPECT_EQ(outlook(535).end, End::time) << "warm-up does not end before its time is over";
  reach(RunPhase::searching, 0);
  status_.search_fraction = 0.25;
  EXPECT_FLOAT_EQ(outlook(60).done, 0.25f);
  EXPECT_EQ(outlook_text(outlook(60)), "At most 8 minutes to go");
}

TEST_F(RunOutlookTest, SaysInWordsWhatComesNext) {
  const auto text = [](double seconds, End end) { return outlook_text({0.5f, seconds, end, false}); };
  EXPECT_EQ(text(170, End::goal), "About 3 minutes to go, until the draws are good enough");
  EXPECT_EQ(text(64, End::time), "About 1 minute to go, until its time is over");
  EXPECT_EQ(text(3, End::draws), "A few seconds to go, until all draws are made");
  EXPECT_EQ(text(41, End::warmup), "Warm-up takes about 40 seconds more; then draws count");
}

TEST(DurationText, SaysNoMoreThanAGuessKnows) {
  EXPECT_EQ(duration_text(0), "a few seconds");
  EXPECT_EQ(duration_text(12), "about 10 seconds");
  EXPECT_EQ(duration_text(54), "about 50 seconds");
  EXPECT_EQ(duration_text(56), "about 1 minute");
  EXPECT_EQ(duration_text(10 * 60 + 20), "about 10 minutes");
  EXPECT_EQ(duration_text(56 * 60), "about 1 hour");
  EXPECT_EQ(duration_text(5.4 * 3600), "about 5 hours");
}

TEST(AgreementText, TellsAgreementFromItsFigures) {
  const auto text = [](double rhat) { return agreement_text({1000, "rough", 271.8, "light", rhat}); };
  EXPECT_EQ(text(1.004), "Chains agree (R-hat 1.00): 271 independent draws");
  EXPECT_EQ(text(1.04), "Chains nearly agree (R-hat 1.04): 271 independent draws");
  EXPECT_EQ(text(1.7), "Chains do not agree yet (R-hat 1.70): 271 independent draws");
  EXPECT_EQ(agreement_text({}), "Too few draws to say whether the chains agree");
}

}  // namespace
}  // namespace patina
