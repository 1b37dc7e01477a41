#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "gui/history.h"

namespace patina {
namespace {

TEST(HistoryTest, UndoAndRedoWalkAlongTheStepsAndStopAtTheirEnds) {
  History<std::string> history("a");
  EXPECT_FALSE(history.undo());
  EXPECT_FALSE(history.redo());
  history.change("b", true);
  history.change("c", true);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), "b");
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), "a");
  EXPECT_FALSE(history.undo());
  EXPECT_TRUE(history.redo());
  EXPECT_TRUE(history.redo());
  EXPECT_EQ(history.now(), "c");
  EXPECT_FALSE(history.redo());
}

TEST(HistoryTest, AGestureOfManyChangesIsOneStep) {
  History<int> history(0);
  history.change(1, true);
  for (int i = 2; i <= 40; ++i) history.change(i, false);
  history.change(50, true);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 40);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 0);
  EXPECT_FALSE(history.can_undo());
  EXPECT_TRUE(history.redo());
  EXPECT_EQ(history.now(), 40) << "a gesture is redone to its end";
}

TEST(HistoryTest, AChangeAfterUndoForgetsWhatWasUndone) {
  History<int> history(0);
  history.change(1, true);
  history.change(2, true);
  history.undo();
  history.change(3, true);
  EXPECT_FALSE(history.can_redo());
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 1);
}

TEST(HistoryTest, AGestureThatGoesOnAfterUndoBeginsAStepOfItsOwn) {
  History<int> history(0);
  history.change(1, true);
  history.change(2, true);
  history.undo();
  history.change(7, false);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 1) << "the earlier step is not overwritten";
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 0);
}

TEST(HistoryTest, WhatChangesNothingLeavesNoStep) {
  History<int> history(5);
  history.change(5, true);
  EXPECT_FALSE(history.can_undo());
  history.change(6, true);
  history.undo();
  history.change(5, true);
  EXPECT_TRUE(history.can_redo()) << "and forgets nothing";
}

TEST(HistoryTest, AGestureThatReturnsToItsStartLeavesNoStep) {
  History<int> history(5);
  history.change(6, true);
  history.change(5, false);
  EXPECT_FALSE(history.can_undo());
  history.change(8, false);
  history.change(9, false);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 5) << "and can go on from there";
}

TEST(HistoryTest, AGestureThatBeginsWithTheSameStateIsApartFromTheOneBefore) {
  History<int> history(0);
  history.change(1, true);
  history.change(1, true);
  history.change(2, false);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 1);
}

TEST(HistoryTest, KeepsTheNewestSteps) {
  History<std::size_t> history(0);
  constexpr std::size_t kSteps = History<std::size_t>::kMost + 40;
  for (std::size_t i = 1; i <= kSteps; ++i) history.change(i, true);
  std::size_t steps = 0;
  while (history.undo()) ++steps;
  EXPECT_EQ(steps, History<std::size_t>::kMost);
  EXPECT_EQ(history.now(), 40u);
}

TEST(HistoryTest, AnyMixtureOfStepsAgreesWithAListOfStates) {
  std::mt19937 rng(3);
  History<int> history(0);
  std::vector<int> states{0};
  std::size_t place = 0;
  for (int i = 1; i < 5000; ++i) {
    switch (rng() % 3) {
      case 0:
        history.change(i, true);
        states.resize(place + 1);
        states.push_back(i);
        ++place;
        break;
      case 1:
        EXPECT_EQ(history.can_undo(), place > 0);
        if (history.undo()) --place;
        break;
      default:
        EXPECT_EQ(history.can_redo(), place + 1 < states.size());
        if (history.redo()) ++place;
    }
    ASSERT_EQ(history.now(), states[place]);
  }
}

}  // namespace
}  // namespace patina
