// What Dear ImGui lays out lands on the window's pixels.

#include "gl_fixture.h"
#include "gui/gl/imgui_renderer.h"
#include "gui/gl/objects.h"

namespace patina {
namespace {

constexpr Rgb kBlack{0, 0, 0};

TEST_F(GlTest, ARectangleCoversItsPixelsAndNoOthers) {
  const Image shot = frame([](ImDrawList& list) {
    list.AddRectFilled({8, 4}, {24, 20}, IM_COL32(200, 100, 50, 255));
  });
  ASSERT_EQ(shot.width, 64);
  ASSERT_EQ(shot.height, 48);
  for (int row = 0; row < shot.height; ++row) {
    for (int column = 0; column < shot.width; ++column) {
      const bool inside = row >= 4 && row < 20 && column >= 8 && column < 24;
      ASSERT_EQ(pixel(shot, row, column), (inside ? Rgb{200, 100, 50} : kBlack)) << row << ", " << column;
    }
  }
}

TEST_F(GlTest, TheClipRectangleCutsExactly) {
  const Image shot = frame([](ImDrawList& list) {
    list.PushClipRect({10, 12}, {30, 22});
    list.AddRectFilled({0, 0}, {64, 48}, IM_COL32_WHITE);
    list.PopClipRect();
  });
  int lit = 0;
  for (int row = 0; row < shot.height; ++row) {
    for (int column = 0; column < shot.width; ++column) {
      const bool inside = row >= 12 && row < 22 && column >= 10 && column < 30;
      ASSERT_EQ(pixel(shot, row, column), (inside ? Rgb{255, 255, 255} : kBlack)) << row << ", " << column;
      lit += inside;
    }
  }
  EXPECT_EQ(lit, 200);
}

TEST_F(GlTest, ALargeFillBetweenOthersCoversWhatIsBelowAndNotWhatIsAbove) {
  const Image shot = frame([](ImDrawList& list) {
    list.AddRectFilled({0, 0}, {60, 8}, IM_COL32(0, 200, 0, 255));
    list.AddRectFilled({0.4f, 4.6f}, {60.5f, 46.5f}, IM_COL32(200, 0, 0, 255));  // is cleared to
    list.AddRectFilled({10, 20}, {20, 30}, IM_COL32(0, 0, 200, 255));
  });
  for (int row = 0; row < shot.height; ++row) {
    for (int column = 0; column < shot.width; ++column) {
      Rgb expected = kBlack;
      if (row < 8 && column < 60) expected = {0, 200, 0};
      // Pixels whose middles lie inside: rows 5 to 45, columns 0 to 59.
      if (row >= 5 && row < 46 && column < 60) expected = {200, 0, 0};
      if (row >= 20 && row < 30 && column >= 10 && column < 20) expected = {0, 0, 200};
      ASSERT_EQ(pixel(shot, row, column), expected) << row << ", " << column;
    }
  }
}

TEST_F(GlTest, ALargeFillStaysInItsClipRectangle) {
  const Image shot = frame([](ImDrawList& list) {
    list.PushClipRect({10, 12}, {30, 22});
    list.AddRectFilled({-100, -100}, {164, 148}, IM_COL32(200, 100, 0, 255));
    list.PopClipRect();
  });
  EXPECT_EQ(pixel(shot, 12, 10), (Rgb{200, 100, 0}));
  EXPECT_EQ(pixel(shot, 21, 29), (Rgb{200, 100, 0}));
  for (const auto& [row, column] :
       {std::pair(11, 10), std::pair(22, 29), std::pair(12, 9), std::pair(21, 30)})
    EXPECT_EQ(pixel(shot, row, column), kBlack) << row << ", " << column;
}

TEST_F(GlTest, HalfOpacityBlendsHalfWay) {
  const Image shot = frame([](ImDrawList& list) {
    list.AddRectFilled({0, 0}, {64, 48}, IM_COL32(0, 0, 200, 255));
    list.AddRectFilled({0, 0}, {64, 48}, IM_COL32(200, 0, 0, 128));
  });
  const Rgb mixed = pixel(shot, 20, 20);
  EXPECT_NEAR(mixed.red, 200 * 128 / 255.0, 1);
  EXPECT_NEAR(mixed.blue, 200 * 127 / 255.0, 1);
}

TEST_F(GlTest, APictureIsShownUprightAndUnmirrored) {
  Image corners(2, 2, 3);
  corners.at(0, 0, 0) = 1;  // red at the top left
  corners.at(0, 1, 1) = 1;  // green at the top right
  corners.at(1, 0, 2) = 1;  // blue at the bottom left
  const Texture texture = Texture::picture(gl(), corners);
  const Image shot = frame([&](ImDrawList& list) { list.AddImage(texture.imgui_id(), {0, 0}, {40, 40}); });
  EXPECT_EQ(pixel(shot, 4, 4), (Rgb{255, 0, 0}));
  EXPECT_EQ(pixel(shot, 4, 36), (Rgb{0, 255, 0}));
  EXPECT_EQ(pixel(shot, 36, 4), (Rgb{0, 0, 255}));
  EXPECT_EQ(pixel(shot, 36, 36), kBlack);
}

TEST_F(GlTest, PremultipliedImagesKeepTheirColourAndTheNextItemBlendsAsUsual) {
  const std::array<std::uint8_t, 4> half_white{128, 128, 128, 128};
  const Texture texture = Texture::rgba8(gl(), 1, 1, half_white, TextureFilter::nearest);
  const Image shot = frame([&](ImDrawList& list) {
    {
      const PremultipliedImages premultiplied(list);
      list.AddImage(texture.imgui_id(), {0, 0}, {16, 16});
    }
    list.AddImage(texture.imgui_id(), {32, 0}, {48, 16});
  });
  EXPECT_EQ(pixel(shot, 8, 8).red, 128);
  EXPECT_NEAR(pixel(shot, 8, 40).red, 64, 1) << "the same texture, taken as not premultiplied";
}

TEST_F(GlTest, AListOfMoreThan65536VerticesIsDrawnWhole) {
  const Image shot = frame([](ImDrawList& list) {
    for (int i = 0; i < 20000; ++i) list.AddRectFilled({0, 0}, {8, 8}, IM_COL32(0, 0, 255, 255));
    list.AddRectFilled({32, 32}, {48, 48}, IM_COL32(0, 255, 0, 255));
  });
  EXPECT_EQ(pixel(shot, 40, 40), (Rgb{0, 255, 0}));
  EXPECT_EQ(pixel(shot, 4, 4), (Rgb{0, 0, 255}));
}

TEST_F(GlTest, ScreenshotsCanBeTakenTwiceAndAreTheSame) {
  const Image first = frame([](ImDrawList& list) { list.AddCircleFilled({30, 20}, 9, IM_COL32_WHITE); });
  EXPECT_EQ(first.pixels, window->screenshot().pixels);
}

}  // namespace
}  // namespace patina
