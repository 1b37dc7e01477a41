// The window without a display: its input reaches Dear ImGui as a hand would give it, and it sleeps when
// idle.

#include <chrono>
#include <thread>

#include "gl_fixture.h"
#include "gui/window/fonts.h"

namespace patina {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Runs frames of one full-window panel until all input has been taken and answered.
template <class LayOut>
void run_frames(OffscreenWindow& window, LayOut lay_out) {
  for (int settling = 0; settling < 3; settling = window.input_taken() ? settling + 1 : 0) {
    window.begin_frame(0);
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoDecoration);
    lay_out();
    ImGui::End();
    window.end_frame();
  }
}

TEST_F(GlTest, AClickPressesAButtonOnce) {
  int presses = 0;
  const auto panel = [&] {
    ImGui::SetCursorPos({8, 8});
    presses += ImGui::Button("go", {20, 20});
  };
  window->click(50, 40);
  run_frames(*window, panel);
  EXPECT_EQ(presses, 0) << "beside the button";
  window->click(18, 18);
  run_frames(*window, panel);
  EXPECT_EQ(presses, 1);
}

TEST_F(GlTest, ADoubleClickAndADragAreSeenAsSuch) {
  int double_clicks = 0;
  float dragged = 0;
  const auto panel = [&] {
    double_clicks += ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Right)) {
      dragged = ImGui::GetMouseDragDelta(ImGuiMouseButton_Right).x;
    }
  };
  window->double_click(20, 20);
  window->drag(10, 10, 40, 10, ImGuiMouseButton_Right);
  run_frames(*window, panel);
  EXPECT_EQ(double_clicks, 1);
  EXPECT_EQ(dragged, 30);
}

TEST_F(GlTest, TextIsTypedAndEnterIsSeen) {
  char text[32] = "";
  bool entered = false;
  bool focus = true;
  const auto panel = [&] {
    if (std::exchange(focus, false)) ImGui::SetKeyboardFocusHere();
    entered |= ImGui::InputText("name", text, sizeof text, ImGuiInputTextFlags_EnterReturnsTrue);
  };
  run_frames(*window, panel);
  window->type("caf\u00e9");
  window->tap_key(ImGui::GetKeyIndex(ImGuiKey_Enter));
  run_frames(*window, panel);
  EXPECT_STREQ(text, "caf\u00e9");
  EXPECT_TRUE(entered);
}

TEST_F(GlTest, AShortcutIsSeenWithItsModifier) {
  int seen = 0, plain = 0;
  const auto panel = [&] {
    const bool pressed = ImGui::IsKeyPressed('E', false);
    seen += pressed && ImGui::GetIO().KeyCtrl;
    plain += pressed && !ImGui::GetIO().KeyCtrl;
  };
  window->hold_modifiers(ImGuiKeyModFlags_Ctrl);
  window->tap_key('E');
  window->hold_modifiers(ImGuiKeyModFlags_None);
  window->tap_key('E');
  run_frames(*window, panel);
  EXPECT_EQ(seen, 1);
  EXPECT_EQ(plain, 1);
}

TEST_F(GlTest, DroppedFilesAreHandedOverOnce) {
  window->drop_files({"/photos/a b.jpg", "/photos/c.png"});
  window->begin_frame(0);
  window->end_frame();
  EXPECT_EQ(window->take_dropped_files().size(), 2u);
  EXPECT_TRUE(window->take_dropped_files().empty());
}

TEST_F(GlTest, TheClipboardKeepsText) {
  ImGui::SetClipboardText("albedo_r 0.4");
  EXPECT_STREQ(ImGui::GetClipboardText(), "albedo_r 0.4");
}

TEST_F(GlTest, AnIdleFrameSleepsAndAWakeFromAnotherThreadEndsTheSleep) {
  const auto timed_frame = [&](double timeout) {
    const auto start = Clock::now();
    window->begin_frame(timeout);
    const double slept = seconds_since(start);
    window->end_frame();
    return slept;
  };
  EXPECT_GE(timed_frame(0.05), 0.05);
  std::jthread waker([&] { window->wake(); });
  EXPECT_LT(timed_frame(60), 30);
  EXPECT_LT(timed_frame(60), 30) << "what woke it settles over the next frames";
}

TEST_F(GlTest, AfterAResizeAllOfTheWindowIsDrawn) {
  window->resize(100, 80);
  const Image shot = frame([](ImDrawList& list) {
    list.AddRectFilled({90, 70}, {100, 80}, IM_COL32(255, 0, 0, 255));
  });
  ASSERT_EQ(shot.width, 100);
  ASSERT_EQ(shot.height, 80);
  EXPECT_EQ(pixel(shot, 75, 95), (Rgb{255, 0, 0}));
}

TEST_F(GlTest, BothWeightsHaveLatinGreekAndArrows) {
  const Fonts fonts = load_fonts(16, 1);
  window->begin_frame(0);
  window->end_frame();
  for (const ImFont* font : {fonts.regular, fonts.semibold}) {
    for (const ImWchar letter : {0x41, 0xe9, 0x3c3, 0x2013, 0x2192, 0x2264, 0x25b6}) {
      EXPECT_NE(font->FindGlyphNoFallback(letter), nullptr) << "code point " << letter;
    }
  }
  const Image shot = frame([&](ImDrawList& list) { list.AddText({4, 4}, IM_COL32_WHITE, "\u03c3"); });
  float brightest = 0;
  for (const float value : shot.pixels) brightest = std::max(brightest, value);
  EXPECT_GT(brightest, 0.5f);
}

TEST_F(GlTest, DenserPixelsMakeLargerGlyphsOfTheSameSizeOnScreen) {
  const float plain = load_fonts(16, 1).regular->FontSize * ImGui::GetIO().FontGlobalScale;
  const float dense = load_fonts(16, 2).regular->FontSize * ImGui::GetIO().FontGlobalScale;
  EXPECT_FLOAT_EQ(plain, dense);
}

}  // namespace
}  // namespace patina
