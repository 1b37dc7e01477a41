#include <fstream>
#include <set>

#include "gui/fuzzy.h"
#include "gui/window/theme.h"
#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

class AppBehaviour : public AppTest {
 protected:
  void type(const std::string& text) {
    window_->type(text);
    answer_input();
  }
  const Action& action(const std::string& name) const {
    for (const Action& each : app_.actions())
      if (each.name == name) return each;
    throw std::runtime_error("no action " + name);
  }
};

TEST_F(AppBehaviour, NoTwoActionsShareAKeyOrAName) {
  std::set<std::string> keys, names;
  for (const Action& action : app_.actions()) {
    EXPECT_TRUE(names.insert(action.name).second) << action.name;
    for (const Shortcut& shortcut : action.shortcuts)
      EXPECT_TRUE(keys.insert(shortcut.text()).second) << shortcut.text() << ": " << action.name;
  }
}

TEST_F(AppBehaviour, EveryActionIsFoundInThePaletteByItsOwnName) {
  for (const Action& wanted : app_.actions()) {
    for (const Action& other : app_.actions()) {
      if (&wanted == &other) continue;
      EXPECT_GT(fuzzy_score(wanted.name, wanted.name), fuzzy_score(wanted.name, other.name)) << wanted.name;
    }
  }
}

TEST_F(AppBehaviour, ThePaletteCarriesOutWhatIsTyped) {
  start_run_of({draw(0.4, 0.5, -1)});
  press('K', ImGuiKeyModFlags_Ctrl);
  ASSERT_TRUE(app_.palette().visible());
  type("pause");
  press(ImGui::GetKeyIndex(ImGuiKey_Enter));
  EXPECT_FALSE(app_.palette().visible());
  EXPECT_EQ(run_->pauses, 1);
}

TEST_F(AppBehaviour, ArrowsChooseInThePaletteAndEscapeLeavesItWithoutAnythingDone) {
  press('P', ImGuiKeyModFlags_Ctrl | ImGuiKeyModFlags_Shift);
  type("show");
  press(ImGui::GetKeyIndex(ImGuiKey_DownArrow));
  press(ImGui::GetKeyIndex(ImGuiKey_Escape));
  EXPECT_FALSE(app_.palette().visible());
  EXPECT_EQ(app_.preview().view().subject, Subject::photographed);
  press('K', ImGuiKeyModFlags_Ctrl);
  type("show: ");
  press(ImGui::GetKeyIndex(ImGuiKey_Enter));
  const Subject first = app_.preview().view().subject;
  press('K', ImGuiKeyModFlags_Ctrl);
  type("show: ");
  press(ImGui::GetKeyIndex(ImGuiKey_DownArrow));
  press(ImGui::GetKeyIndex(ImGuiKey_Enter));
  EXPECT_NE(app_.preview().view().subject, first);
}

TEST_F(AppBehaviour, LettersTypedIntoThePaletteAreNoShortcuts) {
  start_run_of({draw(0.4, 0.5, -1)});
  press('K', ImGuiKeyModFlags_Ctrl);
  window_->press_key('W');
  window_->type("w");
  window_->release_key('W');
  answer_input();
  EXPECT_EQ(app_.preview().view().comparison, Comparison::off);
}

TEST_F(AppBehaviour, TextGrowsAndShrinksByKeysWithinLimits) {
  const float before = ImGui::GetFontSize();
  press('=', ImGuiKeyModFlags_Ctrl);
  frames(2);
  EXPECT_GT(ImGui::GetFontSize(), before);
  press('0', ImGuiKeyModFlags_Ctrl);
  frames(2);
  EXPECT_EQ(ImGui::GetFontSize(), before);
  for (int i = 0; i < 40; ++i) action("Larger text and panels").run();
  frames(3);
  EXPECT_EQ(app_.preferences().scale, Preferences::kMostScale);
}

TEST_F(AppBehaviour, TheLightThemeIsLightAndItsTextDark) {
  const float dark = window_->screenshot().at(5, 300, 1);
  const ImU32 dark_text = theme::kText;
  action("Light or dark theme").run();
  frames(3);
  EXPECT_GT(window_->screenshot().at(5, 300, 1), dark + 0.5f);
  EXPECT_LT(static_cast<ImU32>(theme::kText) & 255, dark_text & 255);
  action("Light or dark theme").run();
  frames(3);
  EXPECT_EQ(window_->screenshot().at(5, 300, 1), dark);
}

TEST_F(AppBehaviour, PointsTakeTheThemesColours) {
  start_run_of({draw(0.3, 0.5, -1), draw(0.5, 0.4, -2, 3)});
  app_.session().model().colour_by({Colouring::Kind::chain, {}});
  const auto colour = [&](std::size_t draw) {
    frames(3);
    const Image shot = window_->screenshot();
    const ImVec2 at = pixel_of(draw);
    std::array<float, 3> rgb{};
    for (int c = 0; c < 3; ++c)
      rgb[static_cast<std::size_t>(c)] = shot.at(static_cast<int>(at.y), static_cast<int>(at.x), c);
    return rgb;
  };
  for (int theme = 0; theme < 2; ++theme) {
    const auto seen = colour(1);
    const ImU32 point = theme::chain_color(3), ground = theme::kWell;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto part = [&](ImU32 color) { return static_cast<double>(color >> (8 * c) & 255) / 255; };
      const double alpha = 200.0 / 255;
      // A line of the grid may lie beneath.
      EXPECT_NEAR(seen[c], alpha * part(point) + (1 - alpha) * part(ground), 0.05) << "theme " << theme;
    }
    action("Light or dark theme").run();
  }
  frames(3);
}

/// Text and what lies behind it differ enough to be read (WCAG 2.1, AA), in both themes.
TEST_F(AppBehaviour, TextCanBeReadInBothThemes) {
  const auto luminance = [](ImU32 color) {
    double sum = 0;
    const double weights[] = {0.2126, 0.7152, 0.0722};
    for (int c = 0; c < 3; ++c) {
      const double v = static_cast<double>(color >> (8 * c) & 255) / 255;
      sum += weights[c] * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return sum;
  };
  const auto contrast = [&](ImU32 a, ImU32 b) {
    const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
    return std::max(x, y) / std::min(x, y);
  };
  for (const theme::Theme theme : {theme::Theme::dark, theme::Theme::light}) {
    theme::apply(15, theme);
    EXPECT_GT(contrast(theme::kText, theme::kPanel), 7);
    for (const ImU32 ground : {ImU32(theme::kPanel), ImU32(theme::kWell)})
      for (const ImU32 text : {ImU32(theme::kMuted), ImU32(theme::kWarning), ImU32(theme::kAccent)})
        EXPECT_GT(contrast(text, ground), 4.5) << static_cast<int>(theme);
    EXPECT_GT(contrast(theme::kError, theme::kBanner), 4.5);
    EXPECT_GT(contrast(theme::kOnAccent, theme::kAccent), 4.5);
  }
  theme::apply(15, theme::Theme::dark);
}

class AppMemory : public AppTest {
 protected:
  /// The program, started once more with what it remembers.
  std::unique_ptr<App> start() {
    return std::make_unique<App>(*window_, factory(), folder_.path() / "runs", file_);
  }

  std::filesystem::path file_ = folder_.path() / "config" / "settings.json";
};

TEST_F(AppMemory, ReopensTheRunAndTheDrawThatWereThere) {
  std::filesystem::create_directories(folder_.path() / "run");
  std::ofstream(folder_.path() / "run" / "run.json") << "{}";
  std::vector<Draw> draws{draw(0.3, 0.5, -2, 0), draw(0.4, 0.5, -1, 1), draw(0.5, 0.5, -3, 1)};
  draws[2].iteration = 7;
  {
    const auto app = start();
    EXPECT_FALSE(app->reopen()) << "nothing was open before";
    app->load(folder_.path() / "run");
    run_->feed(draws);
    app->frame(0);
    app->session().model().select(2);
    app->frame(0);
  }
  const auto app = start();
  ASSERT_TRUE(app->reopen());
  EXPECT_EQ(app->session().run().directory(), folder_.path() / "run");
  app->frame(0);
  EXPECT_FALSE(app->session().model().selected()) << "its draws have not been read yet";
  run_->feed(draws);
  for (int i = 0; i < 3; ++i) app->frame(0);
  EXPECT_EQ(app->session().model().selected(), 2u);
}

TEST_F(AppMemory, RemembersRecentFilesThemeAndScale) {
  {
    const auto app = start();
    app->load(photo_);
    for (const Action& action : app->actions())
      if (action.name == "Larger text and panels" || action.name == "Light or dark theme") action.run();
    app->frame(0);
  }
  const auto app = start();
  ASSERT_FALSE(app->preferences().recent.empty());
  EXPECT_EQ(app->preferences().recent.front(), photo_);
  EXPECT_TRUE(app->preferences().light_theme);
  EXPECT_FLOAT_EQ(app->preferences().scale, 1.1f);
  for (const Action& action : app->actions())
    if (action.name == "Light or dark theme") action.run();
  app->frame(0);
}

TEST_F(AppMemory, ABrokenFileIsIgnoredWithASentence) {
  std::filesystem::create_directories(file_.parent_path());
  std::ofstream(file_) << "{\"width\": 12";
  const auto app = start();
  app->frame(0);
  EXPECT_TRUE(app->banner().visible());
  EXPECT_EQ(app->preferences().scale, 1);
}

TEST_F(AppMemory, ARunThatIsGoneIsNotReopened) {
  std::filesystem::create_directories(folder_.path() / "run");
  std::ofstream(folder_.path() / "run" / "run.json") << "{}";
  {
    const auto app = start();
    app->load(folder_.path() / "run");
    app->frame(0);
  }
  std::filesystem::remove_all(folder_.path() / "run");
  EXPECT_FALSE(start()->reopen());
}

}  // namespace
}  // namespace patina::testing
