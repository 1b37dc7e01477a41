#include "gui/plot/plot_cursor.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

constexpr PlotView kView{0, 0, 100, 100, {0, 10}, {-1, 1}};

PlotCursor begun() {
  PlotCursor cursor;
  cursor.begin(kView);
  return cursor;
}

TEST(PlotCursor, BeginsInTheMiddleAndStopsAtTheEdges) {
  PlotCursor cursor = begun();
  EXPECT_EQ(cursor.place().x, 5);
  EXPECT_EQ(cursor.place().y, 0);
  cursor.move(0.25, 0.25, kView);
  EXPECT_EQ(cursor.place().x, 7.5);
  EXPECT_EQ(cursor.place().y, 0.5) << "up is up";
  for (int i = 0; i < 9; ++i) cursor.move(0.25, -0.25, kView);
  EXPECT_EQ(cursor.place().x, 10);
  EXPECT_EQ(cursor.place().y, -1);
}

TEST(PlotCursor, ClosesABoxAtItsSecondCorner) {
  PlotCursor cursor = begun();
  EXPECT_TRUE(cursor.outline(MarkingTool::box).empty());
  EXPECT_EQ(cursor.set_corner(MarkingTool::box), PlotCursor::Step::opened);
  cursor.move(0.1, 0.5, kView);
  EXPECT_EQ(cursor.outline(MarkingTool::box).size(), 4u) << "it is seen while it is drawn";
  EXPECT_EQ(cursor.set_corner(MarkingTool::box), PlotCursor::Step::closed);
  ASSERT_EQ(cursor.finished().size(), 4u);
  EXPECT_EQ(cursor.finished()[0].x, 5);
  EXPECT_EQ(cursor.finished()[2].x, 6);
  EXPECT_EQ(cursor.finished()[2].y, 1);
  EXPECT_TRUE(cursor.outline(MarkingTool::box).empty()) << "the next box begins anew";
}

TEST(PlotCursor, ClosesALassoWhereACornerIsSetTwice) {
  PlotCursor cursor = begun();
  for (const auto& [right, up] : {std::pair(0.0, 0.0), {0.1, 0.0}, {0.0, 0.1}}) {
    cursor.move(right, up, kView);
    EXPECT_EQ(cursor.set_corner(MarkingTool::lasso), PlotCursor::Step::opened);
  }
  EXPECT_EQ(cursor.set_corner(MarkingTool::lasso), PlotCursor::Step::closed);
  EXPECT_EQ(cursor.finished().size(), 3u);
}

TEST(PlotCursor, PointsWhereTheFirstCornerIsSetTwice) {
  for (const MarkingTool tool : {MarkingTool::box, MarkingTool::lasso}) {
    PlotCursor cursor = begun();
    cursor.set_corner(tool);
    EXPECT_EQ(cursor.set_corner(tool), PlotCursor::Step::pointed);
  }
}

}  // namespace
}  // namespace patina
