#include <random>

#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

/// A hand that knows nothing: clicks, drags, wheel and keys anywhere, while draws arrive.
class AppRandomInput : public AppTest {
 protected:
  float anywhere(float extent) { return std::uniform_real_distribution<float>(0, extent)(rng_); }

  void do_something() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float x = anywhere(size.x), y = anywhere(size.y);
    static constexpr std::array<ImGuiKeyModFlags, 4> kModifiers{
        ImGuiKeyModFlags_None, ImGuiKeyModFlags_None, ImGuiKeyModFlags_Shift, ImGuiKeyModFlags_Ctrl};
    window_->hold_modifiers(kModifiers[rng_() % kModifiers.size()]);
    switch (rng_() % 6) {
      case 0:
        return window_->click(x, y);
      case 1:
        return window_->drag(x, y, anywhere(size.x), anywhere(size.y));
      case 2:
        return window_->drag(x, y, anywhere(size.x), anywhere(size.y), ImGuiMouseButton_Right);
      case 3:
        window_->move_mouse(x, y);
        return window_->scroll(0, anywhere(6) - 3);
      case 4:
        return window_->tap_key(kKeys[rng_() % kKeys.size()]);
      default:
        return window_->tap_key(ImGui::GetKeyIndex(kNamedKeys[rng_() % kNamedKeys.size()]));
    }
  }

  void feed() {
    std::normal_distribution<double> normal;
    std::vector<Draw> draws;
    for (int i = 0; i < 40; ++i, ++made_) {
      draws.push_back(
          draw(0.4 + 0.05 * normal(rng_), 0.5 + 0.1 * normal(rng_), -std::abs(normal(rng_)), made_ % 3));
      draws.back().iteration = made_ / 3;
      draws.back().warmup = made_ < 300;
    }
    run_->feed(draws);
  }

  void expect_sound() const {
    const ExplorerModel& model = app_.session().model();
    const std::size_t size = model.draws().size();
    EXPECT_LT(model.selected().value_or(0), std::max<std::size_t>(size, 1));
    EXPECT_LE(model.marked().size(), size);
    for (const Star& star : model.stars()) EXPECT_LT(model.draw_of(star).value_or(0), size);
  }

  static constexpr std::array<char, 11> kKeys{'P', 'A', 'T', 'G', 'B', 'L', 'K', 'M', 'S', 'Z', 'Y'};
  static constexpr std::array<ImGuiKey, 4> kNamedKeys{ImGuiKey_Escape, ImGuiKey_LeftArrow,
                                                      ImGuiKey_RightArrow, ImGuiKey_Enter};
  std::mt19937 rng_{11};
  int made_ = 0;
};

TEST_F(AppRandomInput, OfAnyKindLeavesTheWindowSoundWhileDrawsArrive) {
  start_run_of({});
  for (int event = 0; event < 150; ++event) {
    feed();
    do_something();
    while (!window_->input_taken()) app_.frame(0);
    if (event % 50 == 25) window_->resize(640 + 320 * (event / 50), 480 + 160 * (event / 50));
    expect_sound();
  }
}

}  // namespace
}  // namespace patina::testing
