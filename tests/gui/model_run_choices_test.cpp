#include <gtest/gtest.h>

#include <cmath>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "gui/run_choices.h"

namespace patina {
namespace {

class RunChoicesTest : public ::testing::Test {
 protected:
  const TruncatedNormal& own(const char* name) const {
    return choices_.material().continuous[*choices_.material().find_continuous(name)].prior;
  }
  const TruncatedNormal& chosen(const char* name) const {
    return choices_.table().continuous[*choices_.table().find_continuous(name)].prior;
  }

  RunChoices choices_;
};

TEST_F(RunChoicesTest, ALockHoldsAParameterAndUndoLetsItGo) {
  choices_.lock("rough", 0.33);
  EXPECT_TRUE(choices_.locked("rough"));
  EXPECT_EQ(choices_.settings().fixed.at("rough"), 0.33);
  EXPECT_EQ(choices_.typical().continuous[*choices_.table().find_continuous("rough")], 0.33);
  choices_.undo();
  EXPECT_FALSE(choices_.locked("rough"));
  choices_.redo();
  EXPECT_TRUE(choices_.locked("rough"));
  choices_.unlock("rough");
  EXPECT_TRUE(choices_.settings().fixed.empty());
}

TEST_F(RunChoicesTest, ALockedValueStaysInTheRangeThatTheEngineTakes) {
  choices_.lock("rough", 99);
  EXPECT_EQ(choices_.settings().fixed.at("rough"), own("rough").high);
  choices_.set_material("leather");
  const DiscreteParameter& cells = choices_.table().discrete.front();
  choices_.lock(cells.name, 1.9);
  EXPECT_EQ(choices_.settings().fixed.at(cells.name), 2);
  choices_.lock(cells.name, 1e9);
  EXPECT_EQ(choices_.settings().fixed.at(cells.name), static_cast<double>(cells.levels.size() - 1));
  EXPECT_EQ(choices_.typical().discrete.front(), static_cast<int>(cells.levels.size()) - 1);
}

TEST_F(RunChoicesTest, AnEditedPriorIsInTheTableAndWithinWhatTheMaterialAllows) {
  choices_.set_prior("rough", {0.3, 0.05, -4, 7}, true);
  EXPECT_EQ(chosen("rough"), (TruncatedNormal{0.3, 0.05, own("rough").low, own("rough").high}));
  choices_.reset_prior("rough");
  EXPECT_EQ(chosen("rough"), own("rough"));
  EXPECT_TRUE(choices_.settings().priors.empty());
}

TEST_F(RunChoicesTest, StopRulesAreTakenUpOrRefusedWithASentence) {
  const RunSettings before = choices_.settings();
  choices_.set_stop_rules({.minutes = 30, .ess = 1000, .rhat = 0});
  EXPECT_EQ(choices_.settings().stop.ess, 1000);
  EXPECT_FALSE(choices_.differ_from(before)) << "another end is no other question";
  EXPECT_THROW(choices_.set_stop_rules({.minutes = 0, .ess = 0, .rhat = 1}), UserError);
  EXPECT_THROW(choices_.set_stop_rules({.minutes = std::nan(""), .ess = 0, .rhat = 0}), UserError);
  EXPECT_EQ(choices_.settings().stop.minutes, 30);
  choices_.undo();
  EXPECT_EQ(choices_.settings().stop, before.stop);
}

TEST_F(RunChoicesTest, AnotherErrorModelIsAnotherQuestionAndCanBeTakenBack) {
  const RunSettings before = choices_.settings();
  choices_.set_errors("calibrated");
  EXPECT_TRUE(choices_.differ_from(before));
  choices_.undo();
  EXPECT_FALSE(choices_.differ_from(before));
}

TEST_F(RunChoicesTest, APriorThatIsTheMaterialsOwnIsNoChange) {
  const RunSettings before = choices_.settings();
  choices_.set_prior("rough", own("rough"), true);
  EXPECT_FALSE(choices_.differ_from(before));
}

TEST_F(RunChoicesTest, ADragIsOneStepBack) {
  const TruncatedNormal start = chosen("rough");
  for (int i = 0; i <= 20; ++i) {
    TruncatedNormal prior = start;
    prior.mean = 0.3 + 0.01 * i;
    choices_.set_prior("rough", prior, i == 0);
  }
  choices_.undo();
  EXPECT_EQ(chosen("rough"), start);
  EXPECT_FALSE(choices_.can_undo());
}

TEST_F(RunChoicesTest, WhatIsNoDistributionIsRefusedInASentenceAndChangesNothing) {
  const RunSettings before = choices_.settings();
  const auto [mean, sd, low, high] = own("rough");
  for (const TruncatedNormal& bad : {TruncatedNormal{mean, 0, low, high},
                                     {mean, -1, low, high},
                                     {mean, sd, high, low},
                                     {mean, sd, low, low},
                                     {1e9, sd, low, high},
                                     {std::nan(""), sd, low, high},
                                     {mean, std::nan(""), low, high}}) {
    try {
      choices_.set_prior("rough", bad, true);
      ADD_FAILURE() << bad.mean << " " << bad.sd << " " << bad.low << " " << bad.high;
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find("Roughness"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(choices_.settings(), before);
  EXPECT_FALSE(choices_.can_undo());
}

TEST_F(RunChoicesTest, AnotherMaterialForgetsLocksAndPriorsAndUndoBringsThemBack) {
  choices_.lock("rough", 0.4);
  choices_.set_prior("light", {1000, 50, 0, 2000}, true);
  const RunSettings before = choices_.settings();
  choices_.set_material("leather");
  EXPECT_TRUE(choices_.settings().fixed.empty());
  EXPECT_TRUE(choices_.settings().priors.empty());
  EXPECT_EQ(choices_.table().material, "leather");
  choices_.undo();
  EXPECT_EQ(choices_.settings(), before);
  EXPECT_EQ(choices_.table().material, "bump");
  EXPECT_EQ(chosen("light").mean, 1000);
}

TEST_F(RunChoicesTest, OnlyWhatIsInferredDiffersFromARun) {
  RunSettings run = choices_.settings();
  run.summary = "gram";
  run.draws *= 2;
  run.stop = {};
  EXPECT_FALSE(choices_.differ_from(run));
  choices_.lock("rough", 0.4);
  EXPECT_TRUE(choices_.differ_from(run));
  choices_.undo();
  choices_.set_size_cm(10);
  EXPECT_TRUE(choices_.differ_from(run));
  choices_.undo();
  EXPECT_FALSE(choices_.differ_from(run));
}

TEST_F(RunChoicesTest, UnknownMaterialsAndNamesChangeNothing) {
  const RunSettings before = choices_.settings();
  EXPECT_THROW(choices_.set_material("unobtainium"), UserError);
  choices_.lock("nothing", 1);
  choices_.set_prior("nothing", {}, true);
  EXPECT_EQ(choices_.settings(), before);
  EXPECT_FALSE(choices_.can_undo());
}

}  // namespace
}  // namespace patina
