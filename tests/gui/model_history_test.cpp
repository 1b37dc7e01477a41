#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "gui/history.h"

namespace patina {
namespace {

TEST(History, UndoAndRedoVisitWhatARowOfPagesWould) {
  // The reference: pages of a book, of which those after the present one are torn out by a new one.
  std::mt19937 rng(1);
  History<int> history(0);
  std::vector<int> pages{0};
  std::size_t here = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    ASSERT_EQ(history.can_undo(), here > 0);
    ASSERT_EQ(history.can_redo(), here + 1 < pages.size());
    switch (rng() % 4) {
      case 0:
        if (here > 0) --here;
        ASSERT_EQ(history.undo(), pages[here]);
        break;
      case 1:
        if (here + 1 < pages.size()) ++here;
        ASSERT_EQ(history.redo(), pages[here]);
        break;
      default: {
        const int next = static_cast<int>(rng() % 3);
        history.note(next);
        if (next == pages[here]) break;
        pages.resize(++here);
        pages.push_back(next);
        if (pages.size() > History<int>::kMostSteps + 1) pages.erase(pages.begin()), --here;
      }
    }
  }
}

TEST(History, NotingWhatIsThereAlreadyIsNoStepAndKeepsWhatCanBeRedone) {
  History<int> history(1);
  history.note(1);
  EXPECT_FALSE(history.can_undo());
  history.note(2);
  history.undo();
  history.note(1);
  EXPECT_TRUE(history.can_redo());
}

TEST(History, OnlyTheOldestStepsAreForgotten) {
  History<std::size_t> history(0);
  for (std::size_t i = 1; i <= 3 * History<int>::kMostSteps; ++i) history.note(i);
  std::size_t steps = 0;
  while (history.can_undo()) history.undo(), ++steps;
  EXPECT_EQ(steps, History<int>::kMostSteps);
  EXPECT_EQ(history.undo(), 2 * History<int>::kMostSteps);
}

}  // namespace
}  // namespace patina
