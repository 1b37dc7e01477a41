#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

class AppUndo : public AppTest {
 protected:
  using Show = ScatterPanel::Show;
  void undo() { press('Z', ImGuiKeyModFlags_Ctrl); }
  void type(char character) {
    window_->type(std::string(1, character));
    answer_input();
  }
  void redo() { press('Y', ImGuiKeyModFlags_Ctrl); }
  const PreviewView& preview() const { return app_.preview().view(); }
};

TEST_F(AppUndo, GoesBackThroughWhatTheWindowShowedAndForwardAgain) {
  start_run_of({draw(0.25, 0.2, -1), draw(0.55, 0.8, -1)});
  type('3');
  ASSERT_EQ(preview().subject, Subject::sphere);
  type('+');
  press('T');
  press('=', ImGuiKeyModFlags_Ctrl);
  const float larger = app_.preferences().scale;
  ASSERT_GT(larger, 1);
  const float text = ImGui::GetFontSize();
  undo();
  EXPECT_EQ(app_.preferences().scale, 1);
  EXPECT_LT(ImGui::GetFontSize(), text);
  EXPECT_EQ(app_.scatter().shown(), Show::trace);
  undo();
  EXPECT_EQ(app_.scatter().shown(), Show::plot);
  EXPECT_EQ(preview().stops, 0.5f);
  undo();
  EXPECT_EQ(preview().stops, 0);
  EXPECT_EQ(preview().subject, Subject::sphere);
  undo();
  EXPECT_EQ(preview().subject, Subject::photographed);
  for (int i = 0; i < 4; ++i) redo();
  EXPECT_EQ(preview().stops, 0.5f);
  EXPECT_EQ(app_.scatter().shown(), Show::trace);
  EXPECT_EQ(app_.preferences().scale, larger);
}

TEST_F(AppUndo, TakesTurnsOfTheWheelInARowForOneZoom) {
  start_run_of({draw(0.25, 0.2, -1), draw(0.55, 0.8, -1), draw(0.4, 0.5, -1)});
  click(pixel_of(1));
  const PlotView before = app_.scatter().view();
  const ImVec2 at = pixel_of(2);
  window_->move_mouse(at.x, at.y);
  for (int turn = 0; turn < 3; ++turn) {
    window_->scroll(0, 1);
    answer_input();
  }
  const PlotRange zoomed = app_.scatter().view().x;
  ASSERT_LT(zoomed.span(), 0.7 * before.x.span());
  undo();
  EXPECT_EQ(app_.scatter().view().x, before.x);
  EXPECT_EQ(app_.session().model().selected(), 1u);
  redo();
  EXPECT_EQ(app_.scatter().view().x, zoomed);
  undo();
  undo();
  EXPECT_EQ(app_.session().model().selected(), std::nullopt);
}

TEST_F(AppUndo, DoesNotTakeALampThatFollowsTheMouseForAStep) {
  start_run_of({draw(0.25, 0.2, -1), draw(0.55, 0.8, -1)});
  type('3');
  ASSERT_TRUE(frames_until([&] { return app_.preview().has_render(); })) << "nothing is lit before";
  const auto before = preview().light;
  const Rect square = app_.preview().square();
  window_->move_mouse(square.position.x + 0.3f * square.size.x, square.position.y + 0.6f * square.size.y);
  answer_input();
  ASSERT_NE(preview().light, before);
  const auto lit = preview().light;
  window_->move_mouse(1, 1);
  undo();
  EXPECT_EQ(preview().subject, Subject::photographed);
  EXPECT_EQ(preview().light, lit);
}

TEST_F(AppUndo, TakesBackAxesAndPlotTogetherThatOneClickOnAPairChose) {
  start_run_of({draw(0.25, 0.2, -1), draw(0.55, 0.8, -1), draw(0.4, 0.5, -1)});
  const PlotAxis x = app_.session().model().x_axis(), y = app_.session().model().y_axis();
  press('A');
  ASSERT_TRUE(frames_until([&] { return !app_.scatter().busy(); }));
  const PlotView cell = app_.scatter().matrix().cell_view(5, 4);
  click({cell.left + 0.5f * cell.width, cell.top + 0.5f * cell.height});
  ASSERT_EQ(app_.scatter().shown(), Show::plot);
  ASSERT_FALSE(app_.session().model().x_axis() == x && app_.session().model().y_axis() == y);
  undo();
  EXPECT_EQ(app_.scatter().shown(), Show::pairs);
  EXPECT_EQ(app_.session().model().x_axis(), x);
  EXPECT_EQ(app_.session().model().y_axis(), y);
}

}  // namespace
}  // namespace patina::testing
