#include <fstream>
#include <random>

#include "engine/material/renderer.h"
#include "engine/run/stars.h"
#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

class AppGallery : public AppTest {
 protected:
  const ExplorerModel& model() const { return app_.session().model(); }
  const Gallery& gallery() const { return app_.scatter().gallery(); }
  const std::filesystem::path& directory() const { return app_.session().run().directory(); }

  void start_row() {
    std::vector<Draw> draws;
    for (int i = 0; i < 4; ++i) {
      draws.push_back(draw(0.25 + 0.1 * i, 0.15 + 0.25 * i, -i));
      draws.back().iteration = i;
    }
    start_run_of(draws);
    std::filesystem::create_directories(directory());
  }

  void star(std::size_t index) {
    app_.session().model().select(index);
    frames(1);
    press('S');
  }

  /// A part of the window.
  Image part(const Rect& rect) const {
    const Image whole = window_->screenshot();
    Image part(static_cast<int>(rect.size.x), static_cast<int>(rect.size.y), 3);
    for (int row = 0; row < part.height; ++row) {
      for (int column = 0; column < part.width; ++column) {
        for (int c = 0; c < 3; ++c) {
          part.at(row, column, c) = whole.at(row + static_cast<int>(rect.position.y),
                                             column + static_cast<int>(rect.position.x), c);
        }
      }
    }
    return part;
  }

  /// The mean colour of the middle of a picture, away from its frame and star.
  std::array<double, 3> colour_of(const Image& image) const {
    std::array<double, 3> sum{};
    int count = 0;
    for (int row = image.height / 4; row < 3 * image.height / 4; ++row) {
      for (int column = image.width / 4; column < 3 * image.width / 4; ++column, ++count) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += image.at(row, column, static_cast<int>(c));
      }
    }
    for (double& s : sum) s /= count;
    return sum;
  }

  /// Whether the gallery shows the render of a draw.
  bool shows(std::size_t index) const {
    const auto rect = gallery().picture_of(index);
    return rect && looks_like(*rect, index);
  }

  /// Whether a part of the window is the render of a draw.
  bool looks_like(const Rect& rect, std::size_t index) const {
    const RunSettings settings;
    const auto shown = colour_of(part(rect));
    const auto wanted = colour_of(Renderer(settings.material, settings.z_seed, settings.capture)
                                      .render(model().draws().values(index), Thumbnails::kSmall));
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs(shown[c] - wanted[c]) > 0.02) return false;
    }
    return true;
  }
};

TEST_F(AppGallery, StarredDrawsAreShownAsTheirRendersAndAClickSelectsOne) {
  start_row();
  star(1);
  star(3);
  press('G');
  EXPECT_TRUE(frames_until([&] { return shows(1) && shows(3); }));
  EXPECT_FALSE(gallery().picture_of(0));
  const Rect picture = *gallery().picture_of(1);
  click({picture.position.x + 0.5f * picture.size.x, picture.position.y + 0.5f * picture.size.y});
  EXPECT_EQ(model().selected(), 1u);
}

TEST_F(AppGallery, StarsAreOnDiskAsSoonAsTheyAreGivenAndThereWhenTheRunIsOpenedAgain) {
  start_row();
  star(2);
  EXPECT_EQ(read_stars(directory()), (std::vector<Star>{{0, 2, ""}}));
  const auto run = directory();
  std::ofstream(run / "run.json") << "{}";
  run_->feed({draw(0.1, 0.1, -9)});
  app_.load(run);
  EXPECT_EQ(model().stars(), (std::vector<Star>{{0, 2, ""}}));
  press('Z', ImGuiKeyModFlags_Ctrl);
  EXPECT_EQ(model().stars().size(), 1u) << "what was kept is no step of this sitting";
}

TEST_F(AppGallery, UndoTakesAStarBackOnDiskToo) {
  start_row();
  star(2);
  press('Z', ImGuiKeyModFlags_Ctrl);
  EXPECT_TRUE(model().stars().empty());
  EXPECT_TRUE(read_stars(directory()).empty());
}

TEST_F(AppGallery, ANoteThatIsTypedIsKeptWithTheRun) {
  start_row();
  star(2);
  press('G');
  frames(3);
  const Rect picture = *gallery().picture_of(2);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  click({picture.position.x + 30, picture.position.y + picture.size.y + 1.9f * line});
  window_->type("best so far");
  answer_input();
  press('S');
  EXPECT_EQ(model().stars().size(), 1u) << "keys are letters while a note is typed";
  press(ImGui::GetKeyIndex(ImGuiKey_Enter));
  EXPECT_EQ(read_stars(directory()).at(0).note, "best so far");
}

TEST_F(AppGallery, ADamagedStarFileIsSaidSoAndTheRunOpensAllTheSame) {
  const auto run = folder_.path() / "old";
  std::filesystem::create_directories(run);
  std::ofstream(run / "run.json") << "{}";
  std::ofstream(run / "stars.json") << "{";
  app_.load(run);
  frames(2);
  EXPECT_TRUE(app_.session().has_run());
  EXPECT_NE(app_.banner().sentence().find("stars.json"), std::string::npos) << app_.banner().sentence();
}

TEST_F(AppGallery, EveryKindOfSolutionHasAPicture) {
  std::mt19937 rng(1);
  std::normal_distribution<double> normal;
  std::vector<Draw> draws;
  for (int i = 0; i < 600; ++i) {
    const bool second = i % 3 == 0;
    draws.push_back(draw((second ? 0.3 : 0.5) + 0.01 * normal(rng), (second ? 0.8 : 0.3) + 0.02 * normal(rng),
                         -std::abs(normal(rng))));
  }
  start_run_of(draws);
  press('G');
  ASSERT_TRUE(frames_until([&] { return gallery().modes().modes().size() == 2; }));
  for (const FoundMode& mode : gallery().modes().modes())
    EXPECT_TRUE(frames_until([&] { return shows(mode.best); }));
  const auto& modes = gallery().modes().modes();
  EXPECT_NEAR(modes[0].share, 2.0 / 3, 0.01);
  EXPECT_NE(modes[0].best % 3, 0u);
  EXPECT_EQ(modes[1].best % 3, 0u);
}

TEST_F(AppGallery, AllStarredDrawsAreExportedEachToItsFolder) {
  start_row();
  star(0);
  star(2);
  press('G');
  frames(3);
  const Rect panel = lay_out(ImGui::GetIO().DisplaySize, {}, ImGui::GetFontSize()).scatter;
  const ImGuiStyle& style = ImGui::GetStyle();
  const Rect first = *gallery().picture_of(0);
  click({panel.position.x + panel.size.x - style.WindowPadding.x - 40,
         panel.position.y + style.WindowPadding.y + ImGui::GetTextLineHeightWithSpacing() +
             0.5f * ImGui::GetFrameHeight()});
  ASSERT_TRUE(app_.dialog().visible()) << first.position.y;
  press('A', ImGuiKeyModFlags_Ctrl);
  const auto target = folder_.path() / "starred";
  window_->type(target.string());
  answer_input();
  press(ImGui::GetKeyIndex(ImGuiKey_Enter));
  ASSERT_TRUE(frames_until([&] { return !app_.exporting(); }));
  EXPECT_FALSE(app_.banner().visible()) << app_.banner().sentence();
  EXPECT_TRUE(std::filesystem::exists(target / "chain1-step1" / "params.json"));
  EXPECT_TRUE(std::filesystem::exists(target / "chain1-step3" / "params.json"));
}

TEST_F(AppGallery, HoveringOverADrawShowsItsRender) {
  start_row();
  for (const std::size_t index : {1u, 2u}) {
    const ImVec2 at = pixel_of(index), padding = ImGui::GetStyle().WindowPadding;
    window_->move_mouse(at.x, at.y);
    answer_input();
    // A tooltip's corner lies 24 pixels right of the pointer.
    const float side = 8.5f * ImGui::GetFontSize();
    const Rect picture{{at.x + 24 + padding.x, at.y + padding.y}, {side, side}};
    EXPECT_TRUE(frames_until([&] { return looks_like(picture, index); })) << index;
  }
}

}  // namespace
}  // namespace patina::testing
