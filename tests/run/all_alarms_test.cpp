#include "engine/run/all_alarms.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

/// A grain whose place in the texture jumps, and a roughness.
ParameterTable grain_and_rough() {
  ParameterTable table;
  table.material = "small";
  table.continuous = {{"grain", "", "", {0.5, 0.25, 0, 1}}, {"rough", "", "", {0.5, 0.25, 0, 1}}};
  table.continuous[0].jagged = true;
  return table;
}

RunSummary summary_of(double rhat, std::int64_t draws_of_each) {
  RunSummary summary;
  QuantitySummary grain;
  grain.name = "grain";
  grain.rhat = rhat;
  grain.bulk_ess = grain.tail_ess = 900;
  grain.sd_over_prior_sd = 0.2;
  summary.quantities = {grain};
  for (int k = 0; k < 4; ++k) {
    summary.chains.emplace_back();
    summary.chains.back().chain = k;
    summary.chains.back().draws = draws_of_each;
  }
  return summary;
}

TEST(ApartAlarm, SaysThatErrorsLearntFromSimulatedPhotosLetChainsAgree) {
  const std::optional<Alarm> alarm = apart_alarm({}, grain_and_rough(), summary_of(1.3, kApartDraws));
  ASSERT_TRUE(alarm);
  for (const char* part : {"1.30", "grain", "--errors calibrated"})
    EXPECT_NE(alarm->sentence.find(part), std::string::npos) << part << " in: " << alarm->sentence;
}

TEST(ApartAlarm, NamesTheAverageWhereItIsNotInForce) {
  RunSettings settings;
  const RunSummary apart = summary_of(1.3, kApartDraws);
  EXPECT_NE(apart_alarm(settings, grain_and_rough(), apart)->sentence.find("--errors averaged"),
            std::string::npos);
  settings.errors = "averaged";
  const std::optional<Alarm> alarm = apart_alarm(settings, grain_and_rough(), apart);
  ASSERT_TRUE(alarm);
  EXPECT_EQ(alarm->sentence.find("--errors averaged"), std::string::npos);
}

TEST(ApartAlarm, IsNotGivenWhereThereIsNothingToAverageOverOrNothingIsKnownYet) {
  const RunSummary apart = summary_of(1.3, kApartDraws);
  EXPECT_FALSE(apart_alarm({}, grain_and_rough(), summary_of(1.04, kApartDraws))) << "chains agree";
  EXPECT_FALSE(apart_alarm({}, grain_and_rough(), summary_of(1.3, kApartDraws - 1))) << "too few draws";
  RunSettings settings;
  settings.errors = "calibrated";
  EXPECT_FALSE(apart_alarm(settings, grain_and_rough(), apart)) << "it is done already";
  settings = {};
  settings.fixed["grain"] = 0.5;
  EXPECT_FALSE(apart_alarm(settings, grain_and_rough(), apart)) << "the grain stays where it is";
  ParameterTable smooth = grain_and_rough();
  smooth.continuous[0].jagged = false;
  EXPECT_FALSE(apart_alarm({}, smooth, apart)) << "more draws help";
}

TEST(AllAlarms, AreTheRunsThoseOfTheDrawsAndThatChainsAreApart) {
  RunSummary summary = summary_of(1.3, kApartDraws);
  summary.alarms = {{"bound", "Of the draws."}};
  RunStatus status;
  status.alarms = {{"dark", "Of the photo."}};
  const Alarms alarms = all_alarms({}, grain_and_rough(), status, summary);
  ASSERT_EQ(alarms.size(), 3u);
  EXPECT_EQ(alarms[0].name, "dark");
  EXPECT_EQ(alarms[1].name, "bound");
  EXPECT_EQ(alarms[2].name, "apart");
}

}  // namespace
}  // namespace patina
