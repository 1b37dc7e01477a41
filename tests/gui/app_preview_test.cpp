#include "engine/material/renderer.h"
#include "tests/gui/app_fixture.h"

namespace patina::testing {
namespace {

class AppPreview : public AppTest {
 protected:
  Image engine_render(const ParameterValues& values) const {
    const RunSettings settings;
    return Renderer(settings.material, settings.z_seed, settings.capture)
        .render(values, app_.preview().view().resolution);
  }

  /// Whether the preview shows the engine's render of these values.
  bool shows(const ParameterValues& values) const {
    return app_.preview().has_render() &&
           mean_difference(app_.preview().render(), engine_render(values)) < 2.0 / 255;
  }

  /// A draw whose render is brighter than the photo, which is grey all over.
  void show_bright_draw() {
    const Draw only = draw(0.25, 0.9, -1);
    start_run_of({only});
    ASSERT_TRUE(frames_until([&] { return shows(only.values); }));
    frames(2);
  }

  void type(const char* text) {
    window_->type(text);
    answer_input();
  }

  /// A point of the picture, across and down from 0 to 1, in the window.
  ImVec2 spot(float x, float y) const {
    const Rect& square = app_.preview().square();
    return {square.position.x + x * square.size.x, square.position.y + y * square.size.y};
  }
  float grey_at(ImVec2 at) {
    return window_->screenshot().at(static_cast<int>(at.y), static_cast<int>(at.x), 0);
  }

  static constexpr float kPhoto = 0.4f;
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

TEST_F(AppPreview, WhatIsPressedIsRenderedInAdvanceButShownOnlyWhereAClickSelectsIt) {
  const std::vector<Draw> draws{draw(0.25, 0.2, -1), draw(0.55, 0.8, -2), draw(0.4, 0.5, -3)};
  start_run_of(draws);
  ASSERT_TRUE(frames_until([&] { return shows(draws[0].values); }));
  const auto hold = [&](std::size_t index) {
    window_->move_mouse(pixel_of(index).x, pixel_of(index).y);
    window_->press_mouse();
    for (int i = 0; i < 50; ++i) app_.frame(0.02);  // in which it is rendered
  };
  hold(1);
  EXPECT_TRUE(shows(draws[0].values));
  window_->release_mouse();
  EXPECT_TRUE(frames_until([&] { return shows(draws[1].values); }));

  hold(2);
  window_->move_mouse(pixel_of(2).x + 30, pixel_of(2).y + 30);
  window_->release_mouse();
  for (int i = 0; i < 50; ++i) app_.frame(0.02);
  EXPECT_TRUE(shows(draws[1].values)) << "a drag marks draws";
  click(pixel_of(2));
  EXPECT_TRUE(frames_until([&] { return shows(draws[2].values); })) << "what was foreseen in vain";
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

TEST_F(AppPreview, DraggingMovesTheBorderBetweenPhotoAndRenderWhichStaysWhereItIsPut) {
  show_bright_draw();
  const ImVec2 middle = spot(0.5f, 0.6f);
  ASSERT_GT(std::abs(grey_at(spot(0.4f, 0.6f)) - kPhoto), 0.05f);
  const float right = grey_at(spot(0.6f, 0.6f));
  window_->move_mouse(middle.x, middle.y);
  window_->press_mouse();
  window_->release_mouse();
  answer_input();
  window_->move_mouse(5, 5);
  answer_input();
  EXPECT_NEAR(grey_at(spot(0.4f, 0.6f)), kPhoto, 1.5 / 255);
  EXPECT_NEAR(grey_at(spot(0.6f, 0.6f)), right, 1.5 / 255);
  press('R');
  EXPECT_GT(std::abs(grey_at(spot(0.4f, 0.6f)) - kPhoto), 0.05f) << "the render alone again";
  press('W');
  EXPECT_NEAR(grey_at(spot(0.4f, 0.6f)), kPhoto, 1.5 / 255) << "the border is where it was";
}

TEST_F(AppPreview, SideBySideShowsBothWhole) {
  show_bright_draw();
  const float corner = grey_at(spot(0.03f, 0.03f)), middle = grey_at(spot(0.5f, 0.5f));
  ASSERT_GT(std::abs(corner - middle), 0.1f) << "the flash is in the middle";
  press('N');
  const Rect& square = app_.preview().square();
  const float y = square.position.y + 0.5f * square.size.y;
  EXPECT_NEAR(grey_at({square.position.x + 0.1f * square.size.x, y}), kPhoto, 1.5 / 255);
  EXPECT_NEAR(grey_at({square.position.x + 0.4f * square.size.x, y}), kPhoto, 1.5 / 255);
  EXPECT_NEAR(grey_at({square.position.x + 0.75f * square.size.x, y}), middle, 0.08);
}

TEST_F(AppPreview, ADifferenceIsBlackOrGreyWhereThePhotoIsTheRender) {
  const Draw only = draw(0.25, 0.5, -1);
  Image picture = engine_render(only.values);
  write_image(photo_, picture);
  start_run_of({only});
  ASSERT_TRUE(frames_until([&] { return shows(only.values); }));
  press('D');
  for (const float x : {0.1f, 0.5f, 0.8f}) EXPECT_LT(grey_at(spot(x, 0.5f)), 12.0 / 255) << x;
  app_.preview().view().signed_difference = true;
  frames(2);
  for (const float x : {0.1f, 0.5f, 0.8f}) EXPECT_NEAR(grey_at(spot(x, 0.5f)), 0.5, 12.0 / 255) << x;
}

TEST_F(AppPreview, ExposureActsOnPhotoAndRenderAlike) {
  show_bright_draw();
  press('W');
  const float photo = grey_at(spot(0.2f, 0.9f)), render = grey_at(spot(0.9f, 0.9f));
  type("-");
  type("-");
  const auto darker = [](float v) {
    const double linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4), half = linear / 2;
    return half <= 0.0031308 ? 12.92 * half : 1.055 * std::pow(half, 1 / 2.4) - 0.055;
  };
  EXPECT_EQ(app_.preview().view().stops, -1);
  EXPECT_NEAR(grey_at(spot(0.2f, 0.9f)), darker(photo), 2.0 / 255);
  EXPECT_NEAR(grey_at(spot(0.9f, 0.9f)), darker(render), 4.0 / 255);
  type("0");
  EXPECT_NEAR(grey_at(spot(0.2f, 0.9f)), photo, 1.0 / 255);
}

TEST_F(AppPreview, FlickerShowsPhotoAndRenderByTurns) {
  show_bright_draw();
  const float render = grey_at(spot(0.5f, 0.8f));
  press('F');
  int photos = 0, renders = 0;
  for (int frame = 0; frame < 4 * 36; ++frame) {  // of 1/60 s
    frames(1);
    const float grey = grey_at(spot(0.5f, 0.8f));
    photos += std::abs(grey - kPhoto) < 1.5 / 255;
    renders += std::abs(grey - render) < 1.5 / 255;
  }
  EXPECT_NEAR(photos, 72, 3);
  EXPECT_NEAR(renders, 72, 3);
}

TEST_F(AppPreview, TheLampOnABallFollowsTheMouseAndStaysWhenItLeaves) {
  show_bright_draw();
  type("3");
  ASSERT_EQ(app_.preview().view().subject, Subject::sphere);
  const auto light_from = [&](float x) {
    const ImVec2 at = spot(x, 0.5f);
    window_->move_mouse(at.x, at.y);
    answer_input();
  };
  ASSERT_TRUE(frames_until([&] { return !app_.previews_waiting(); }));
  light_from(0.2f);
  const float left = grey_at(spot(0.3f, 0.5f)), right = grey_at(spot(0.7f, 0.5f));
  EXPECT_GT(left, right + 0.1f);
  light_from(0.8f);
  EXPECT_GT(grey_at(spot(0.7f, 0.5f)), grey_at(spot(0.3f, 0.5f)) + 0.1f);
  const float before = grey_at(spot(0.7f, 0.5f));
  window_->move_mouse(5, 5);
  answer_input();
  EXPECT_EQ(grey_at(spot(0.7f, 0.5f)), before);
}

TEST_F(AppPreview, TheRightButtonTurnsTheShapeAndTheWheelComesNearer) {
  show_bright_draw();
  type("2");
  ASSERT_TRUE(frames_until([&] { return !app_.previews_waiting(); }));
  const Orbit before = app_.preview().view().orbit;
  const ImVec2 from = spot(0.5f, 0.5f), to = spot(0.8f, 0.5f);
  window_->drag(from.x, from.y, to.x, to.y, ImGuiMouseButton_Right);
  answer_input();
  const Orbit turned = app_.preview().view().orbit;
  EXPECT_LT(turned.eye().x(), before.eye().x()) << "the shape's right side comes to the front";
  EXPECT_FLOAT_EQ(turned.eye().norm(), before.eye().norm());
  window_->scroll(0, 2);
  answer_input();
  EXPECT_LT(app_.preview().view().orbit.eye().norm(), turned.eye().norm());
}

TEST_F(AppPreview, EveryKeyOfASubjectShowsAnotherPicture) {
  show_bright_draw();
  std::vector<Image> pictures;
  for (const char* key : {"1", "2", "3", "4", "5", "6", "7", "8"}) {
    type(key);
    ASSERT_TRUE(frames_until([&] { return !app_.previews_waiting(); }));
    frames(2);
    pictures.push_back(window_->screenshot());
    for (std::size_t i = 0; i + 1 < pictures.size(); ++i)
      EXPECT_GT(mean_difference(pictures[i], pictures.back()), 1e-3) << key << " and " << i + 1;
  }
}

TEST_F(AppPreview, ShowsThePriorsMiddleBeforeAnyRun) {
  app_.load(photo_);
  EXPECT_TRUE(frames_until([&] { return shows(prior_location(table_)); }));
}

}  // namespace
}  // namespace patina::testing
