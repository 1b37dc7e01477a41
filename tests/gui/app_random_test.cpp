// Whatever hands and files do to the window, it neither crashes nor hangs, what it knows stays sound, and it
// can be used afterwards. Under AddressSanitizer (test gui-asan) ten thousand events, here as many as a
// machine has time for.

#include <cstdlib>
#include <fstream>
#include <random>

#include "gui/window/imgui_host.h"
#include "tests/gui/app_fixture.h"

#ifndef PATINA_RANDOM_EVENTS
#define PATINA_RANDOM_EVENTS 250
#endif

namespace patina::testing {
namespace {

/// A hand that knows nothing: mouse, keys, text, files and sizes of the window, while a run goes on.
class AppRandomInput : public AppTest {
 protected:
  AppRandomInput() {
    // What is remembered stays in the test's folder.
    for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME"})
      ::setenv(name, folder_.path().c_str(), 1);
    std::filesystem::create_directories(folder_.path() / "run");
    std::ofstream(folder_.path() / "run" / "run.json") << "{}";
    std::ofstream(folder_.path() / "broken.png") << "\x89PNG\r\n";
    // What is rendered is not what is tested.
    app_.preview().view().resolution = 32;
  }

  int below(int bound) { return static_cast<int>(rng_() % static_cast<unsigned>(bound)); }

  /// From a little left of the window to a little right of it.
  float across(float extent) { return extent * (-0.05f + 0.0011f * static_cast<float>(below(1000))); }

  void point() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    window_->move_mouse(across(size.x), across(size.y));
  }

  void use_mouse() {
    const ImGuiMouseButton button = below(4) == 0 ? 1 + below(2) : 0;
    point();
    switch (below(4)) {
      case 0:
        return window_->press_mouse(button);
      case 1:
        return window_->release_mouse(button);
      case 2:
        return window_->scroll(0, static_cast<float>(below(7) - 3));
      default:
        window_->press_mouse(button);
        point();
        return window_->release_mouse(button);
    }
  }

  void use_keys() {
    static constexpr std::array kNamed{ImGuiKey_Escape,    ImGuiKey_Enter,    ImGuiKey_Tab,
                                       ImGuiKey_LeftArrow, ImGuiKey_UpArrow,  ImGuiKey_DownArrow,
                                       ImGuiKey_Backspace, ImGuiKey_PageDown, ImGuiKey_Home,
                                       ImGuiKey_End,       ImGuiKey_Delete,   ImGuiKey_RightArrow};
    static constexpr std::array<ImGuiKeyModFlags, 5> kModifiers{
        ImGuiKeyModFlags_None, ImGuiKeyModFlags_None, ImGuiKeyModFlags_Ctrl, ImGuiKeyModFlags_Shift,
        ImGuiKeyModFlags_Ctrl | ImGuiKeyModFlags_Shift};
    window_->hold_modifiers(kModifiers[rng_() % kModifiers.size()]);
    const bool named = below(2) == 0;
    window_->tap_key(named ? ImGui::GetKeyIndex(kNamed[rng_() % kNamed.size()]) : ' ' + below('[' - ' '));
    window_->hold_modifiers(ImGuiKeyModFlags_None);
  }

  /// A typed character, of those that lead no path out of the test's folder.
  void type() {
    const char character = static_cast<char>(' ' + below('~' - ' '));
    if (character != '/' && character != '.') window_->type(std::string(1, character));
  }

  void use_files() {
    const std::array choices{photo_, folder_.path() / "broken.png", folder_.path() / "run",
                             folder_.path() / "nothing", folder_.path()};
    std::vector<std::filesystem::path> files;
    for (int i = 1 + below(2); i > 0; --i) files.push_back(choices[rng_() % choices.size()]);
    window_->drop_files(std::move(files));
  }

  void go_on_sampling() {
    run_->status.phase = static_cast<RunPhase>(below(8));
    run_->status.chains.resize(static_cast<std::size_t>(below(5)));
    std::vector<Draw> draws;
    for (int i = below(60); i > 0; --i, ++made_) {
      draws.push_back(draw(0.2 + 0.01 * below(60), 0.01 * below(100), -0.1 * below(100), made_ % 3));
      draws.back().iteration = made_ / 3;
      draws.back().warmup = made_ < 300;
    }
    run_->feed(draws);
  }

  void resize() { window_->resize(160 + below(500), 120 + below(400)); }

  void do_something() {
    const int what = below(100);
    if (what < 50) return use_mouse();
    if (what < 80) return use_keys();
    if (what < 88) return type();
    if (what < 91) return use_files();
    if (what < 97) return go_on_sampling();
    resize();
  }

  /// Nothing is written outside the test's folder: a dialog that stands elsewhere is closed.
  void stay_at_home() {
    if (!app_.dialog().visible()) return;
    const auto way = app_.dialog().folder().lexically_relative(folder_.path());
    if (way.empty() || *way.begin() == "..") window_->tap_key(ImGui::GetKeyIndex(ImGuiKey_Escape));
  }

  void expect_sound() const {
    const ExplorerModel& model = app_.session().model();
    const std::size_t size = model.draws().size();
    const auto there = [&](std::optional<std::size_t> draw) { return !draw || *draw < size; };
    EXPECT_TRUE(there(model.selected()));
    EXPECT_LE(model.marked().size(), size);
    for (const Star& star : model.stars()) EXPECT_TRUE(there(model.draw_of(star)));
    const RunChoices& choices = app_.session().choices();
    for (const auto& [name, value] : choices.settings().fixed) {
      EXPECT_TRUE(choices.table().find_continuous(name) || choices.table().find_discrete(name)) << name;
      EXPECT_TRUE(std::isfinite(value)) << name;
    }
  }

  /// Only what has changed was drawn; all of the window must be as if it were drawn anew.
  void expect_drawn() {
    ImguiRenderer anew(window_->gl());
    ASSERT_TRUE(window_->screenshot().pixels == read_frame(window_->gl(), anew).pixels);
  }

  std::mt19937 rng_{20261121};
  int made_ = 0;
};

TEST_F(AppRandomInput, OfAnyKindLeavesTheWindowSoundAndUsable) {
  start_run_of({});
  for (int event = 0; event < PATINA_RANDOM_EVENTS; ++event) {
    do_something();
    do {
      app_.frame(0);
      stay_at_home();
    } while (!window_->input_taken());
    expect_sound();
    if (event % 10 == 0) expect_drawn();
  }
  window_->resize(1280, 800);
  for (const ImGuiMouseButton button : {0, 1, 2}) window_->release_mouse(button);
  for (int i = 0; i < 8; ++i) press(ImGui::GetKeyIndex(ImGuiKey_Escape));
  start_run_of({draw(0.4, 0.5, -1), draw(0.5, 0.4, -2)});
  press('P');
  click({700, 20});  // on nothing: closes a list that is still open
  click(pixel_of(1));
  EXPECT_EQ(app_.session().model().selected(), 1u);
}

}  // namespace
}  // namespace patina::testing
