// The pictures of the preview besides the one as photographed, against formulas written out for single
// pixels.

#include <cmath>
#include <numbers>

#include "gl_fixture.h"
#include "gui/gl/map_renderer.h"
#include "gui/gl/picture_comparer.h"
#include "gui/gl/shape_renderer.h"
#include "tests/gui/flat_maps.h"

namespace patina {
namespace {

using testing::filled;
using testing::flat_maps;
using testing::srgb;

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

TEST_F(GlTest, ExposureMultipliesLinearLightAndClipsAtWhite) {
  PictureComparer comparer(gl());
  const Texture picture = Texture::picture(gl(), filled(8, {0.2f, 0.6f, 1}));
  for (const float stops : {-2.0f, -0.5f, 0.0f, 1.0f, 3.0f}) {
    const Image shown = comparer.exposed(picture, stops, 8, 0).read();
    int channel = 0;
    for (const double value : {51.0 / 255, 153.0 / 255, 1.0}) {
      EXPECT_NEAR(shown.at(4, 4, channel), srgb(std::exp2(stops) * linear(value)), 0.6 / 255) << stops;
      ++channel;
    }
  }
}

TEST_F(GlTest, ADifferenceIsEnlargedAndBlackOrGreyWhereBothAreAlike) {
  PictureComparer comparer(gl());
  const Texture first = Texture::picture(gl(), filled(8, {0.4f, 0.6f, 0.2f}));
  const Texture second = Texture::picture(gl(), filled(8, {0.6f, 0.6f, 0.16f}));
  const Image plain = comparer.difference(first, second, {.gain = 2}, 8).read();
  EXPECT_EQ(pixel(plain, 4, 4), (Rgb{102, 0, 20}));
  const Image with_sign = comparer.difference(first, second, {.gain = 2, .is_signed = true}, 8).read();
  EXPECT_NEAR(with_sign.at(4, 4, 0), 0.5 - 0.2, 1.0 / 255);
  EXPECT_NEAR(with_sign.at(4, 4, 1), 0.5, 1.0 / 255);
  EXPECT_NEAR(with_sign.at(4, 4, 2), 0.5 + 0.04, 1.0 / 255);
}

TEST_F(GlTest, ADifferenceIsOfTheExposedPictures) {
  PictureComparer comparer(gl());
  const Texture first = Texture::picture(gl(), filled(8, {0.4f, 0.4f, 0.4f}));
  const Texture second = Texture::picture(gl(), filled(8, {0.2f, 0.2f, 0.2f}));
  const Image shown = comparer.difference(first, second, {.stops = 2, .gain = 1}, 8).read();
  EXPECT_NEAR(shown.at(4, 4, 0), srgb(4 * linear(0.4)) - srgb(4 * linear(0.2)), 1.1 / 255);
}

TEST_F(GlTest, EveryMapIsShownAsItIsExported) {
  MaterialMaps maps = flat_maps(16);
  maps.normal = filled(16, {0.6f, 0, 0.8f});
  maps.lobes[0].roughness = filled(16, {0.2f, 0.5f});
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 16; ++column) maps.height.at(row, column, 0) = 3 + 0.1f * column;
  SurfaceTextures textures(gl());
  textures.set(maps);
  MapRenderer renderer(gl());
  const auto shown = [&](Subject map) {
    EXPECT_TRUE(renderer.render(textures, map));
    return renderer.read();
  };
  EXPECT_NEAR(shown(Subject::base_color).at(3, 5, 1), srgb(0.2), 0.6 / 255);
  const Image normal = shown(Subject::normal);
  EXPECT_NEAR(normal.at(3, 5, 0), 0.8, 0.6 / 255);
  EXPECT_NEAR(normal.at(3, 5, 2), 0.9, 0.6 / 255);
  EXPECT_NEAR(shown(Subject::roughness).at(3, 5, 0), 0.35, 0.6 / 255);
  const Image height = shown(Subject::height);
  for (const int column : {0, 5, 15}) EXPECT_NEAR(height.at(9, column, 0), column / 15.0, 0.6 / 255);
}

TEST_F(GlTest, ASurfaceWithoutALobeHasNoRoughnessToShow) {
  MaterialMaps maps = flat_maps(16);
  maps.lobes.clear();
  SurfaceTextures textures(gl());
  textures.set(maps);
  MapRenderer renderer(gl());
  EXPECT_FALSE(renderer.render(textures, Subject::roughness));
  EXPECT_TRUE(renderer.render(textures, Subject::height));
}

class ShapeTest : public GlTest {
 protected:
  Image shown(const MaterialMaps& maps, const ShapeView& view) {
    textures_.set(maps);
    renderer_.render(textures_, view);
    return renderer_.read();
  }

  static ShapeView facing(Subject shape) {
    ShapeView view;
    view.shape = shape;
    view.width = view.height = 65;  // a pixel's centre is in the middle
    return view;
  }

  SurfaceTextures textures_{gl()};
  ShapeRenderer renderer_{gl()};
};

TEST_F(ShapeTest, HeadOnItIsAsBrightAsTheMiddleOfThePhotographBesidesTheEvenLight) {
  const MaterialMaps maps = flat_maps(32);
  for (const Subject shape : {Subject::plane, Subject::sphere}) {
    const Image image = shown(maps, facing(shape));
    for (int k = 0; k < 3; ++k) {
      const double base = maps.base_color.at(0, 0, k), f0 = maps.lobes[0].f0[k];
      const double alpha = 0.4 * 0.4, lobe = f0 / (4 * std::numbers::pi * alpha * alpha);
      const double even = 0.06 * (base + 0.5 * f0) / std::numbers::pi;
      const double radiance = 800 / 625.0 * (base / std::numbers::pi + lobe + even);
      EXPECT_NEAR(image.at(32, 32, k), srgb(radiance), 1.5 / 255) << subject_text(shape);
    }
  }
}

TEST_F(ShapeTest, ABallIsBrightWhereTheLightIsAndTransparentBesideIt) {
  ShapeView view = facing(Subject::sphere);
  for (const auto& [x, y] : {std::pair{0.8f, 0.0f}, {-0.8f, 0.0f}, {0.0f, 0.8f}, {0.0f, -0.8f}}) {
    view.light = light_under(x, y);
    const Image image = shown(flat_maps(32), view);
    const auto at = [&](float right, float up) {
      return image.at(32 - static_cast<int>(16 * up), 32 + static_cast<int>(16 * right), 0);
    };
    EXPECT_GT(at(x, y), at(-x, -y) + 0.15f) << x << ", " << y;
    EXPECT_EQ(image.at(1, 1, 3), 0);
    EXPECT_EQ(image.at(32, 32, 3), 1);
  }
}

TEST_F(ShapeTest, TheLightStaysWithTheCameraAsItTurns) {
  ShapeView view = facing(Subject::sphere);
  view.light = light_under(0.5f, 0.5f);
  const Image before = shown(flat_maps(32), view);
  view.orbit.turn(0.7f, 0.3f);
  const Image after = shown(flat_maps(32), view);
  for (const auto& [row, column] : {std::pair{32, 32}, {24, 40}, {40, 24}})
    EXPECT_NEAR(before.at(row, column, 0), after.at(row, column, 0), 2.0 / 255);
}

TEST_F(ShapeTest, MapsLieUprightOnThePlane) {
  MaterialMaps maps = flat_maps(32);
  maps.lobes.clear();
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 32; ++column) maps.base_color.at(row, column, 0) = column < 16 ? 0.9f : 0;
  ShapeView view = facing(Subject::plane);
  const Image image = shown(maps, view);
  EXPECT_GT(image.at(24, 24, 0), image.at(40, 24, 0) + 0.1f) << "the bright quarter is at the top left";
  EXPECT_LT(image.at(24, 40, 0), image.at(40, 40, 0));
}

TEST_F(ShapeTest, ANormalLeaningToTheLightIsBrighterInEveryCopyMirroredOnesTheOtherWay) {
  MaterialMaps maps = flat_maps(32);
  maps.lobes.clear();
  maps.normal = filled(32, {0.6f, 0, 0.8f});
  ShapeView view = facing(Subject::plane);
  view.copies = 2;
  view.light = light_under(0.7f, 0);
  view.mirrored = false;
  const Image repeated = shown(maps, view);
  EXPECT_NEAR(repeated.at(32, 22, 0), repeated.at(32, 42, 0), 1.0 / 255);
  view.mirrored = true;
  const Image mirrored = shown(maps, view);
  EXPECT_NEAR(mirrored.at(32, 22, 0), repeated.at(32, 22, 0), 1.0 / 255);
  EXPECT_LT(mirrored.at(32, 42, 0), mirrored.at(32, 22, 0) - 0.1f);
}

TEST_F(ShapeTest, AsPhotographedIsTheSameAfterAShapeFilteredItsMaps) {
  MaterialMaps maps = flat_maps(32);
  for (std::size_t i = 0; i < maps.base_color.pixels.size(); ++i)
    maps.base_color.pixels[i] = static_cast<float>(i % 97) / 97;
  shown(maps, facing(Subject::sphere));
  MapRenderer renderer(gl());
  renderer.render(textures_, Subject::base_color);
  const Image image = renderer.read();
  for (const int i : {0, 7, 31}) EXPECT_NEAR(image.at(i, i, 0), srgb(maps.base_color.at(i, i, 0)), 0.6 / 255);
}

}  // namespace
}  // namespace patina
