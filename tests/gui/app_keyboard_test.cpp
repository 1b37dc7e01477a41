#include "gui/window/layout.h"
#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

/// Hands that have no mouse.
class AppKeyboard : public AppTest {
 protected:
  static constexpr int kF6 = 295;  // as GLFW has it

  void tap(ImGuiKey key, int times = 1) {
    for (int i = 0; i < times; ++i) window_->tap_key(ImGui::GetKeyIndex(key));
    answer_input();
  }
  void go_to_panel(int panels) {
    for (int i = 0; i < std::abs(panels); ++i)
      press(kF6, panels < 0 ? ImGuiKeyModFlags_Shift : ImGuiKeyModFlags_None);
  }
  const RunChoices& choices() const { return app_.session().choices(); }
};

TEST_F(AppKeyboard, InAPanelArrowsGoThroughItsButtonsAndSpacePressesThem) {
  start_run_of({draw(0.3, 0.5, -2), draw(0.4, 0.5, -1), draw(0.5, 0.5, -3)});
  go_to_panel(-1);  // the last: the draw that is shown
  tap(ImGuiKey_RightArrow);
  tap(ImGuiKey_RightArrow);
  EXPECT_FALSE(app_.session().model().selected()) << "arrows walk through the buttons, not the draws";
  tap(ImGuiKey_Space);
  EXPECT_EQ(app_.session().model().selected(), 1u) << "Best";
  EXPECT_EQ(run_->pauses, 0) << "Space does not pause meanwhile";
  tap(ImGuiKey_Escape);
  EXPECT_EQ(app_.session().model().selected(), 1u) << "Esc leaves the panel and lets go of nothing";
  tap(ImGuiKey_RightArrow);
  EXPECT_EQ(app_.session().model().selected(), 0u) << "arrows walk through the draws again";
}

TEST_F(AppKeyboard, LocksAParameterWithoutAMouse) {
  start_run_of({draw(0.3, 0.5, -2)});
  const auto advises = [&] { return app_.session().summary().has_value(); };
  ASSERT_TRUE(frames_until(advises)) << "an advice stands above the table";
  frames(2);
  go_to_panel(5);
  for (int i = 0; i < 2; ++i) tap(ImGuiKey_DownArrow);  // past Start, to the table
  tap(ImGuiKey_Space);                                  // into it
  tap(ImGuiKey_DownArrow);                              // past its headings
  tap(ImGuiKey_Space);
  EXPECT_EQ(choices().settings().fixed.size(), 1u);
  tap(ImGuiKey_Space);
  EXPECT_TRUE(choices().settings().fixed.empty());
}

TEST_F(AppKeyboard, ShowsWhereTheKeysAreAndAClickHidesItAgain) {
  start_run_of({draw(0.3, 0.5, -2)});
  const Rect panel = lay_out(ImGui::GetIO().DisplaySize, {}, ImGui::GetFontSize()).draw;
  const auto picture = [&] { return part_of(window_->screenshot(), panel); };
  window_->move_mouse(640, 20);
  answer_input();
  const Image before = picture();
  go_to_panel(-1);
  EXPECT_GT(mean_difference(picture(), before), 0) << "a frame around the first button";
  click({640, 20});
  EXPECT_EQ(mean_difference(picture(), before), 0);
}

TEST_F(AppKeyboard, ChoosesFromAListWithoutAMouse) {
  start_run_of({draw(0.3, 0.5, -2)});
  go_to_panel(5);
  tap(ImGuiKey_Space);
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_Space);
  EXPECT_NE(choices().settings().material, "bump");
}

TEST_F(AppKeyboard, MarksExactlyTheDrawsInABoxWithoutAMouse) {
  start_run_of({draw(0.3, 0.3, -1), draw(0.5, 0.5, -2), draw(0.7, 0.7, -3)});
  press('X');
  tap(ImGuiKey_Enter);  // in the middle
  tap(ImGuiKey_RightArrow, 16);
  tap(ImGuiKey_UpArrow, 16);
  EXPECT_FALSE(app_.session().model().selected()) << "arrows walk through no draws meanwhile";
  tap(ImGuiKey_Enter);
  const DrawSet& marked = app_.session().model().marked();
  EXPECT_FALSE(marked.contains(0));
  EXPECT_TRUE(marked.contains(2)) << "right of the middle, and above";
  tap(ImGuiKey_LeftArrow, 16);
  tap(ImGuiKey_DownArrow, 16);
  tap(ImGuiKey_Space);
  EXPECT_EQ(run_->pauses, 0) << "Space sets a corner meanwhile";
  tap(ImGuiKey_LeftArrow, 16);
  tap(ImGuiKey_DownArrow, 16);
  press(ImGui::GetKeyIndex(ImGuiKey_Enter), ImGuiKeyModFlags_Shift);
  EXPECT_TRUE(marked.contains(0)) << "with Shift it is added";
  EXPECT_TRUE(marked.contains(2));
  tap(ImGuiKey_Escape);
  EXPECT_EQ(marked.size(), 2u + marked.contains(1)) << "Esc ends the marking, not what is marked";
  tap(ImGuiKey_RightArrow);
  EXPECT_TRUE(app_.session().model().selected()) << "arrows walk through the draws again";
}

TEST_F(AppKeyboard, KeepsTheSquareInHandWhenTheOneBeforeHasBeenRead) {
  const std::filesystem::path wide = folder_.path() / "wide.png";
  write_image(wide, Image(160, 80, 3));
  app_.open(wide);
  ASSERT_TRUE(frames_until([&] { return app_.session().has_photo(); }));
  press('Q');
  tap(ImGuiKey_LeftArrow);
  app_.session().recrop(Photo(app_.session().photo()));
  frames(2);
  tap(ImGuiKey_LeftArrow);
  tap(ImGuiKey_Enter);
  EXPECT_EQ(app_.session().chosen_crop(), (PhotoCrop{36, 0, 80}));
  press('Q');
  app_.open(photo_);
  ASSERT_TRUE(frames_until([&] { return app_.session().photo_name() == "oak"; }));
  frames(2);
  EXPECT_FALSE(app_.photo_panel().takes_keys()) << "it was of another photo";
}

TEST_F(AppKeyboard, MovesAndResizesTheSquareOfThePhotoWithoutAMouse) {
  const std::filesystem::path wide = folder_.path() / "wide.png";
  write_image(wide, Image(160, 80, 3));
  app_.open(wide);
  ASSERT_TRUE(frames_until([&] { return app_.session().has_photo(); }));
  frames(2);
  ASSERT_EQ(app_.session().chosen_crop(), (PhotoCrop{40, 0, 80}));
  const float stops = app_.preview().view().stops;
  press('Q');
  tap(ImGuiKey_LeftArrow);
  EXPECT_EQ(app_.session().chosen_crop(), (PhotoCrop{40, 0, 80})) << "it is kept by Enter";
  tap(ImGuiKey_Enter);
  EXPECT_EQ(app_.session().chosen_crop(), (PhotoCrop{38, 0, 80}));
  press('Q');
  for (int i = 0; i < 3; ++i) {
    window_->type("-");
    answer_input();
  }
  EXPECT_EQ(app_.preview().view().stops, stops) << "- resizes the square meanwhile";
  tap(ImGuiKey_Enter);
  EXPECT_EQ(app_.session().chosen_crop(), (PhotoCrop{44, 6, 68}));
  press('Q');
  tap(ImGuiKey_RightArrow);
  tap(ImGuiKey_Escape);
  EXPECT_EQ(app_.session().chosen_crop(), (PhotoCrop{44, 6, 68})) << "Esc leaves it as it was";
  press('Z', ImGuiKeyModFlags_Ctrl);
  EXPECT_EQ(app_.session().chosen_crop(), (PhotoCrop{38, 0, 80}));
}

}  // namespace
}  // namespace patina::testing
