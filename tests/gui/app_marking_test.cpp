#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

/// Draws that are marked in the plot, and what the user takes back.
class AppMarking : public AppTest {
 protected:
  /// Draws on a lattice of 5 x 5.
  void start_lattice() {
    std::vector<Draw> draws;
    for (int i = 0; i < 25; ++i) draws.push_back(draw(0.2 + 0.1 * (i % 5), 0.1 + 0.2 * (i / 5), -i));
    start_run_of(draws);
  }

  const ExplorerModel& model() const { return app_.session().model(); }

  std::vector<std::size_t> marked() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < model().draws().size(); ++i) {
      if (model().marked().contains(i)) indices.push_back(i);
    }
    return indices;
  }

  /// Drags from beside one draw to beside another, both inside the box.
  void drag_box(std::size_t from, std::size_t to) {
    const ImVec2 a = pixel_of(from), b = pixel_of(to);
    const float x = a.x < b.x ? 12.0f : -12.0f, y = a.y < b.y ? 12.0f : -12.0f;
    window_->drag(a.x - x, a.y - y, b.x + x, b.y + y);
    answer_input();
  }

  void undo() { press('Z', ImGuiKeyModFlags_Ctrl); }
  void redo() { press('Y', ImGuiKeyModFlags_Ctrl); }
};

TEST_F(AppMarking, ABoxMarksExactlyTheDrawsInsideAndSelectsNone) {
  start_lattice();
  drag_box(6, 13);
  EXPECT_EQ(marked(), (std::vector<std::size_t>{6, 7, 8, 11, 12, 13}));
  EXPECT_EQ(model().selected(), std::nullopt);
  drag_box(18, 16);
  EXPECT_EQ(marked(), (std::vector<std::size_t>{16, 17, 18})) << "a new box replaces the old one";
}

TEST_F(AppMarking, ALassoMarksExactlyTheDrawsThatItGoesAround) {
  start_lattice();
  press('L');
  // Around draws 6, 7 and 11: a triangle, which a box would fill up to 12.
  const ImVec2 a = pixel_of(6), b = pixel_of(8), c = pixel_of(16);
  window_->move_mouse(a.x - 15, a.y + 15);
  window_->press_mouse();
  window_->move_mouse(b.x - 12, b.y + 15);
  window_->move_mouse(c.x - 15, c.y + 12);
  window_->release_mouse();
  answer_input();
  EXPECT_EQ(marked(), (std::vector<std::size_t>{6, 7, 11}));
}

TEST_F(AppMarking, ShiftAddsToTheMarkedDrawsAndCtrlTakesAway) {
  start_lattice();
  drag_box(0, 1);
  window_->hold_modifiers(ImGuiKeyModFlags_Shift);
  drag_box(23, 24);
  EXPECT_EQ(marked(), (std::vector<std::size_t>{0, 1, 23, 24}));
  window_->hold_modifiers(ImGuiKeyModFlags_Ctrl);
  drag_box(1, 1);
  EXPECT_EQ(marked(), (std::vector<std::size_t>{0, 23, 24}));
}

TEST_F(AppMarking, EscapeLetsGoOfTheMarkedDrawsFirstThenOfTheSelectedOne) {
  start_lattice();
  click(pixel_of(3));
  drag_box(6, 7);
  press(ImGui::GetKeyIndex(ImGuiKey_Escape));
  EXPECT_TRUE(marked().empty());
  EXPECT_EQ(model().selected(), 3u);
  press(ImGui::GetKeyIndex(ImGuiKey_Escape));
  EXPECT_EQ(model().selected(), std::nullopt);
}

TEST_F(AppMarking, MarkedDrawsStayMarkedOverOtherAxesAndStandOut) {
  start_lattice();
  drag_box(6, 7);
  app_.session().model().set_axes(axis("rough"), {PlotAxis::Kind::log_posterior, 0});
  frames(3);
  const Image image = window_->screenshot();
  const auto brightest = [&](std::size_t index) {
    const ImVec2 at = pixel_of(index);
    float brightest = 0;
    for (int channel = 0; channel < 3; ++channel)
      brightest = std::max(brightest, image.at(static_cast<int>(at.y), static_cast<int>(at.x), channel));
    return brightest;
  };
  EXPECT_GT(brightest(6), 0.6f);
  EXPECT_LT(brightest(12), 0.5f);
  EXPECT_EQ(marked(), (std::vector<std::size_t>{6, 7}));
}

TEST_F(AppMarking, UndoTakesBackOneGestureAtATimeAndRedoBringsItAgain) {
  start_lattice();
  const PlotAxis before = model().y_axis();
  click(pixel_of(3));
  drag_box(6, 13);
  app_.session().model().set_axes(axis("rough"), {PlotAxis::Kind::log_posterior, 0});
  frames(2);
  undo();
  EXPECT_EQ(model().y_axis(), before);
  EXPECT_EQ(marked().size(), 6u) << "the box is one step, however long it was dragged";
  undo();
  EXPECT_TRUE(marked().empty());
  EXPECT_EQ(model().selected(), 3u);
  undo();
  EXPECT_EQ(model().selected(), std::nullopt);
  redo();
  redo();
  EXPECT_EQ(marked().size(), 6u);
  press('Z', ImGuiKeyModFlags_Ctrl | ImGuiKeyModFlags_Shift);
  EXPECT_NE(model().y_axis(), before);
}

TEST_F(AppMarking, UndoNeverReachesIntoTheRunBefore) {
  start_lattice();
  click(pixel_of(20));
  start_run_of({draw(0.3, 0.5, -1)});
  undo();
  undo();
  EXPECT_EQ(model().selected(), std::nullopt);
  EXPECT_EQ(model().draws().size(), 1u);
}

TEST_F(AppMarking, ContoursAreDrawnOnRequest) {
  std::vector<Draw> draws;
  for (int i = 0; i < 400; ++i)
    draws.push_back(
        draw(0.4 + 0.05 * std::sin(7.3 * i) * std::cos(2.1 * i), 0.5 + 0.1 * std::sin(1.7 * i), -1));
  start_run_of(draws);
  const Image before = window_->screenshot();
  press('K');
  EXPECT_TRUE(model().shows_contours());
  EXPECT_GT(mean_difference(before, window_->screenshot()), 1e-4);
}

}  // namespace
}  // namespace patina::testing
