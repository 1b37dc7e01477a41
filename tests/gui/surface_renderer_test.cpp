// The preview's shader against the formulas of models.md "Capture", written out once more for single pixels.

#include <array>
#include <numbers>

#include "gl_fixture.h"
#include "gui/gl/surface_renderer.h"
#include "tests/gui/flat_maps.h"

namespace patina {
namespace {

using testing::filled;
using testing::flat_maps;
using testing::srgb;

/// The radiance of a flat surface at a pixel's centre, in double.
std::array<double, 3> flat_radiance(const MaterialMaps& maps, int row, int column) {
  const int n = maps.resolution();
  const double size = maps.capture.size_cm, camera = maps.capture.camera_cm;
  const double x = ((column + 0.5) / n - 0.5) * size, y = -((row + 0.5) / n - 0.5) * size;
  const double d2 = x * x + y * y + camera * camera, c = camera / std::sqrt(d2);
  const double vignette = std::exp(-(x * x + y * y) / (2.0 * maps.vignette_sigma * maps.vignette_sigma));
  std::array<double, 3> radiance;
  for (int k = 0; k < 3; ++k) {
    double f = maps.base_color.at(row, column, k) / std::numbers::pi;
    for (const LobeMaps& lobe : maps.lobes) {
      const double ax = std::pow(lobe.roughness.at(row, column, 0), 2);
      const double ay = std::pow(lobe.roughness.at(row, column, 1), 2);
      const double hx2 = x * x / d2, hy2 = y * y / d2;
      const double d =
          1 / (std::numbers::pi * ax * ay * std::pow(hx2 / (ax * ax) + hy2 / (ay * ay) + c * c, 2));
      f += lobe.f0[k] * d / (4 * c * c);
    }
    radiance[k] = maps.light * vignette * c / d2 * f;
  }
  return radiance;
}

double gamma22(double v) { return std::pow(std::clamp(v, 0.0, 1.0), 1 / 2.2); }

void expect_flat(const Gl& gl, const MaterialMaps& maps, const SurfaceView& view) {
  SurfaceRenderer renderer(gl);
  renderer.set_maps(maps);
  renderer.render(view);
  const Image image = renderer.read();
  for (const auto& [row, column] : {std::pair{0, 0}, {0, 31}, {31, 4}, {15, 16}, {20, 9}, {3, 16}}) {
    const auto radiance = flat_radiance(maps, row, column);
    for (int k = 0; k < 3; ++k) {
      const double lit = radiance[k] * std::exp2(view.exposure);
      const double wanted = view.curve == DisplayCurve::srgb ? srgb(lit) : gamma22(lit);
      EXPECT_NEAR(image.at(row, column, k), wanted, 0.6 / 255) << row << ", " << column << " channel " << k;
    }
  }
}

TEST_F(GlTest, AFlatSurfaceIsShadedAsTheFormulaSays) {
  expect_flat(gl(), flat_maps(32), {DisplayCurve::srgb});
  expect_flat(gl(), flat_maps(32), {DisplayCurve::gamma22});
}

TEST_F(GlTest, ExposureMultipliesRadianceByPowersOfTwo) {
  expect_flat(gl(), flat_maps(32), {DisplayCurve::srgb, -2});
  expect_flat(gl(), flat_maps(32), {DisplayCurve::srgb, 1});
}

TEST_F(GlTest, AnAnisotropicLobeIsLongerAcrossItsRougherDirection) {
  MaterialMaps maps = flat_maps(32);
  maps.lobes[0].roughness = filled(32, {0.25f, 0.5f});
  expect_flat(gl(), maps, {});
}

TEST_F(GlTest, UpToFourLobesAddUp) {
  MaterialMaps maps = flat_maps(32);
  maps.light = 300;
  maps.lobes.clear();
  for (int k = 0; k <= SurfaceRenderer::kMaxLobes; ++k) {
    expect_flat(gl(), maps, {});
    const float rough = 0.2f + 0.1f * static_cast<float>(k);
    maps.lobes.push_back(
        {maps.normal, filled(32, {rough, rough}), {0.02f * static_cast<float>(k + 1), 0.03f, 0.01f}});
  }
}

TEST_F(GlTest, AnotherCaptureMovesTheCamera) {
  MaterialMaps maps = flat_maps(32);
  maps.capture = {.size_cm = 8, .camera_cm = 12};
  maps.light = 150;
  expect_flat(gl(), maps, {});
}

TEST_F(GlTest, LaterMapsReplaceEarlierOnesOfAnotherSize) {
  SurfaceRenderer renderer(gl());
  renderer.set_maps(flat_maps(32));
  renderer.render();
  MaterialMaps dark = flat_maps(20);
  dark.light = 0;
  renderer.set_maps(dark);
  renderer.render();
  const Image image = renderer.read();
  EXPECT_EQ(image.width, 20);
  EXPECT_EQ(pixel(image, 10, 10), (Rgb{0, 0, 0}));
}

TEST_F(GlTest, ATiltTowardsTheLightBrightensTheSideThatFacesIt) {
  // A diffuse surface whose normal leans to +x: brighter where the camera is on that side, at the left.
  MaterialMaps maps = flat_maps(32);
  maps.lobes.clear();
  maps.normal = filled(32, {0.6f, 0, 0.8f});
  SurfaceRenderer renderer(gl());
  renderer.set_maps(maps);
  renderer.render();
  const Image image = renderer.read();
  EXPECT_GT(image.at(16, 6, 0), image.at(16, 25, 0) + 0.05f);
  EXPECT_NEAR(image.at(6, 16, 0), image.at(25, 16, 0), 1.0 / 255) << "no difference up and down";
}

TEST_F(GlTest, ARenderShownLargerThanItIsCoversItsRectangle) {
  MaterialMaps maps = flat_maps(8);
  maps.light = 1e6f;  // white
  SurfaceRenderer renderer(gl());
  renderer.set_maps(maps);
  renderer.render();
  const Image shot = frame([&](ImDrawList& list) {
    list.AddImage(renderer.texture().imgui_id(), {4, 4}, {40, 40});
  });
  EXPECT_EQ(pixel(shot, 5, 5), (Rgb{255, 255, 255}));
  EXPECT_EQ(pixel(shot, 38, 38), (Rgb{255, 255, 255}));
  EXPECT_EQ(pixel(shot, 41, 41), (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace patina
