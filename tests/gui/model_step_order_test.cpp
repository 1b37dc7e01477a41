#include "gui/step_order.h"

#include <gtest/gtest.h>

#include "gui/history.h"

namespace patina {
namespace {

/// Two histories of a number and the order of their steps, as the window keeps them.
struct Desk {
  History<int> left{0}, right{0};
  StepOrder<char> order;

  void set(char which, int value) {
    of(which).change(value, true);
    note();
  }
  void note() { order.note({{'l', left.steps()}, {'r', right.steps()}}); }
  bool undo() {
    return order.undo([this](char which) { return of(which).undo(); });
  }
  bool redo() {
    return order.redo([this](char which) { return of(which).redo(); });
  }
  History<int>& of(char which) { return which == 'l' ? left : right; }
};

TEST(StepOrder, takes_back_the_last_step_of_all_histories_and_makes_it_again) {
  Desk desk;
  desk.set('l', 1);
  desk.set('r', 2);
  desk.set('l', 3);
  EXPECT_TRUE(desk.undo());
  EXPECT_EQ(desk.left.now(), 1);
  EXPECT_TRUE(desk.undo());
  EXPECT_EQ(desk.right.now(), 0);
  EXPECT_TRUE(desk.redo());
  EXPECT_EQ(desk.right.now(), 2);
  EXPECT_EQ(desk.left.now(), 1);
  EXPECT_TRUE(desk.undo());
  EXPECT_TRUE(desk.undo());
  EXPECT_FALSE(desk.undo());
  EXPECT_EQ(desk.left.now(), 0);
}

TEST(StepOrder, takes_back_together_what_one_gesture_did_to_several_histories) {
  Desk desk;
  desk.set('l', 1);
  desk.left.change(2, true);
  desk.right.change(5, true);
  desk.note();
  EXPECT_TRUE(desk.undo());
  EXPECT_EQ(desk.left.now(), 1);
  EXPECT_EQ(desk.right.now(), 0);
  EXPECT_TRUE(desk.redo());
  EXPECT_EQ(desk.left.now(), 2);
  EXPECT_EQ(desk.right.now(), 5);
  EXPECT_TRUE(desk.undo());
  EXPECT_TRUE(desk.undo());
  EXPECT_EQ(desk.left.now(), 0);
  EXPECT_FALSE(desk.undo());
}

TEST(StepOrder, takes_back_one_by_one_the_steps_of_one_history_that_it_is_told_of_late) {
  Desk desk;
  desk.left.change(1, true);
  desk.left.change(2, true);
  desk.note();
  EXPECT_TRUE(desk.undo());
  EXPECT_EQ(desk.left.now(), 1);
  EXPECT_TRUE(desk.undo());
  EXPECT_EQ(desk.left.now(), 0);
}

TEST(StepOrder, forgets_what_was_taken_back_once_there_is_a_new_step_anywhere) {
  Desk desk;
  desk.set('l', 1);
  desk.undo();
  desk.set('r', 2);
  EXPECT_FALSE(desk.redo());
  EXPECT_EQ(desk.left.now(), 0);
}

TEST(StepOrder, passes_over_the_steps_of_a_history_that_began_anew) {
  Desk desk;
  desk.set('r', 2);
  desk.set('l', 1);
  desk.left = History<int>(7);
  desk.note();
  EXPECT_TRUE(desk.undo());
  EXPECT_EQ(desk.right.now(), 0);
  EXPECT_EQ(desk.left.now(), 7);
}

TEST(StepOrder, forgets_a_gesture_that_ended_where_it_began) {
  Desk desk;
  desk.set('r', 2);
  desk.set('l', 1);
  desk.left.change(0, false);
  desk.note();
  EXPECT_TRUE(desk.undo());
  EXPECT_EQ(desk.right.now(), 0);
}

}  // namespace
}  // namespace patina
