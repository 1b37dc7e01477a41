// What is drawn of a frame is what has changed, and the picture is the same as if all of it were.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "gl_fixture.h"
#include "gui/gl/frame_changes.h"
#include "gui/gl/point_renderer.h"
#include "gui/window/imgui_host.h"

namespace patina {
namespace {

class FrameChangesTest : public GlTest {
 protected:
  FrameChangesTest() { window->resize(400, 300); }

  /// The last frame, all of it drawn by a renderer that has drawn nothing before.
  Image drawn_anew() {
    ImguiRenderer renderer(gl());
    return read_frame(gl(), renderer);
  }
};

void add_random_shapes(ImDrawList& list, int count, std::mt19937& random) {
  const auto at = [&] {
    return ImVec2{static_cast<float>(random() % 400), static_cast<float>(random() % 300)};
  };
  for (int i = 0; i < count; ++i) {
    const auto color = static_cast<ImU32>(random());
    switch (random() % 4) {
      case 0:
        list.AddRectFilled(at(), at(), color);
        break;
      case 1:
        list.AddLine(at(), at(), color, 2);
        break;
      case 2:
        list.AddCircleFilled(at(), static_cast<float>(random() % 40), color);
        break;
      default:
        list.AddText(at(), color, "translucent");
    }
  }
}

TEST_F(FrameChangesTest, WhateverFollowsWhateverThePictureIsTheOneThatIsDrawnAnew) {
  std::mt19937 random(1);
  std::vector<unsigned> scenes(6);
  for (int step = 0; step < 60; ++step) {
    scenes[random() % scenes.size()] = random();
    const Image shot = frame([&](ImDrawList& list) {
      for (const unsigned scene : scenes) {
        std::mt19937 own(scene);
        list.PushClipRect({static_cast<float>(scene % 200), 10},
                          {380, static_cast<float>(100 + scene % 190)});
        add_random_shapes(list, 5, own);
        list.PopClipRect();
      }
    });
    ASSERT_EQ(shot.pixels, drawn_anew().pixels) << "step " << step;
  }
}

TEST_F(FrameChangesTest, NewContentsOfATextureAreShown) {
  const std::array<std::uint8_t, 4> red{255, 0, 0, 255}, blue{0, 0, 255, 255};
  Texture texture = Texture::rgba8(gl(), 1, 1, red, TextureFilter::nearest);
  const auto show = [&](ImDrawList& list) { list.AddImage(texture.imgui_id(), {10, 10}, {90, 90}); };
  EXPECT_EQ(pixel(frame(show), 50, 50), (Rgb{255, 0, 0}));
  texture.update(0, 0, 1, 1, blue);
  EXPECT_EQ(pixel(frame(show), 50, 50), (Rgb{0, 0, 255}));
}

TEST_F(FrameChangesTest, AreWhereSomethingChangedAndLittleMore) {
  FrameChanges changes;
  const auto follow = [&](float x) {
    frame([&](ImDrawList& list) {
      list.AddRectFilled({0, 0}, {400, 300}, IM_COL32(20, 20, 20, 255));
      list.AddRectFilled({x, 200}, {x + 10, 210}, IM_COL32_WHITE);
    });
    return changes.follow(*ImGui::GetDrawData(), triangles_of(*ImGui::GetDrawData()));
  };
  ASSERT_EQ(follow(40), (std::vector<PixelRect>{{0, 0, 400, 300}})) << "before, there was none";
  EXPECT_TRUE(follow(40).empty());
  const std::vector<PixelRect> moved = follow(140);
  std::int64_t area = 0;
  for (const PixelRect& rect : moved) area += std::int64_t{rect.width} * rect.height;
  EXPECT_LT(area, 400 * 300 / 8);
  for (const GLint x : {45, 145}) {
    const auto holds = [&](const PixelRect& rect) { return !common_part(rect, {x, 205, 1, 1}).empty(); };
    EXPECT_TRUE(std::ranges::any_of(moved, holds)) << x;
  }
}

TEST_F(FrameChangesTest, OfPointsThatArriveAreAroundThem) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 1);
  PointRenderer points(gl());
  points.set_view({0, 1, 0, 1}, 390, 280);
  FrameChanges changes;
  const auto show = [&] {
    points.render();
    const Image shot = frame([&](ImDrawList& list) { points.show(list, {5, 10}, {395, 290}); });
    EXPECT_EQ(shot.pixels, drawn_anew().pixels) << points.size();
    return changes.follow(*ImGui::GetDrawData(), triangles_of(*ImGui::GetDrawData()));
  };
  show();
  for (int step = 0; step < 40; ++step) {
    const auto color = static_cast<ImU32>(random()) | IM_COL32_A_MASK;
    const PlotPoint fresh{anywhere(random), anywhere(random), color, false};
    points.append({&fresh, 1});
    std::int64_t area = 0;
    for (const PixelRect& rect : show()) area += std::int64_t{rect.width} * rect.height;
    EXPECT_GT(area, 0);
    EXPECT_LE(area, 192 * 192) << "four tiles of the cloud at most, and what they meet of the screen's";
  }
  points.set_view({0, 2, 0, 1}, 390, 280);
  std::int64_t area = 0;
  for (const PixelRect& rect : show()) area += std::int64_t{rect.width} * rect.height;
  EXPECT_GT(area, 380 * 270) << "another view is another picture everywhere";
}

}  // namespace
}  // namespace patina
