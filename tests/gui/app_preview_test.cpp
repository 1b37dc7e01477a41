#include "engine/material/renderer.h"
#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

class AppPreview : public AppTest {
 protected:
  Image engine_render(const ParameterValues& values) const {
    const RunSettings settings;
    return Renderer(settings.material, settings.z_seed, settings.capture)
        .render(values, app_.preview().resolution());
  }

  /// Whether the preview shows the engine's render of these values.
  bool shows(const ParameterValues& values) const {
    return app_.preview().has_render() &&
           mean_difference(app_.preview().render(), engine_render(values)) < 2.0 / 255;
  }
};

TEST_F(AppPreview, AClickReplacesThePreviewByThatDrawsRender) {
  const std::vector<Draw> draws{draw(0.25, 0.2, -1), draw(0.55, 0.8, -2), draw(0.4, 0.5, -3)};
  ASSERT_GT(mean_difference(engine_render(draws[1].values), engine_render(draws[2].values)), 8.0 / 255);
  start_run_of(draws);
  for (const std::size_t index : {1u, 2u}) {
    const Image before = window_->screenshot();
    click(pixel_of(index));
    EXPECT_TRUE(frames_until([&] { return shows(draws[index].values); })) << index;
    frames(2);
    EXPECT_GT(mean_difference(before, window_->screenshot()), 0) << "the window shows it";
  }
  EXPECT_FALSE(shows(draws[1].values)) << "the preview can be told from another draw's";
}

TEST_F(AppPreview, ShowsTheBestDrawUntilOneIsSelectedAndAgainAfterEscape) {
  const std::vector<Draw> draws{draw(0.25, 0.2, -5), draw(0.55, 0.8, -1)};
  start_run_of(draws);
  EXPECT_TRUE(frames_until([&] { return shows(draws[1].values); }));
  click(pixel_of(0));
  EXPECT_TRUE(frames_until([&] { return shows(draws[0].values); }));
  window_->tap_key(ImGui::GetKeyIndex(ImGuiKey_Escape));
  answer_input();
  EXPECT_TRUE(frames_until([&] { return shows(draws[1].values); }));
}

TEST_F(AppPreview, DraggingWipesThePhotoOverTheRender) {
  const Draw only = draw(0.25, 0.9, -1);
  start_run_of({only});
  ASSERT_TRUE(frames_until([&] { return shows(only.values); }));
  frames(2);
  const Rect panel = lay_out(ImGui::GetIO().DisplaySize, {}, ImGui::GetFontSize()).preview;
  const float x = panel.position.x + 0.5f * panel.size.x, y = panel.position.y + 0.6f * panel.size.y;
  const auto at = [&](float pixel_x) {
    return window_->screenshot().at(static_cast<int>(y), static_cast<int>(pixel_x), 0);
  };
  constexpr float kPhoto = 0.4f;  // the photo is grey all over
  ASSERT_GT(std::abs(at(x - 30) - kPhoto), 0.05f);
  const float right = at(x + 30);
  window_->move_mouse(x, y);
  window_->press_mouse();
  answer_input();
  EXPECT_NEAR(at(x - 30), kPhoto, 1.5 / 255);
  EXPECT_NEAR(at(x + 30), right, 1.5 / 255);
  window_->release_mouse();
  answer_input();
  EXPECT_GT(std::abs(at(x - 30) - kPhoto), 0.05f);
}

TEST_F(AppPreview, ShowsThePriorsMiddleBeforeAnyRun) {
  app_.load(photo_);
  EXPECT_TRUE(frames_until([&] { return shows(prior_location(table_)); }));
}

}  // namespace
}  // namespace patina::testing
