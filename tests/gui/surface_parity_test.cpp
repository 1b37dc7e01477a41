// The preview's shader against the engine's own render, for the materials' maps at draws from their priors.

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "gl_fixture.h"
#include "gui/gl/surface_renderer.h"

namespace patina {
namespace {

// The preview has 8 bits: rounding alone makes a mean difference of 1/4 of a level.
constexpr double kTolerance = 0.3 / 255;

ParameterValues prior_draw(const ParameterTable& table, std::mt19937& random) {
  ParameterValues values;
  for (const Parameter& parameter : table.continuous) {
    const TruncatedNormal& prior = parameter.prior;
    std::normal_distribution<double> normal(prior.mean, prior.sd);
    double value = normal(random);
    while (value < prior.low || value > prior.high) value = normal(random);
    values.continuous.push_back(value);
  }
  for (const DiscreteParameter& parameter : table.discrete) {
    values.discrete.push_back(static_cast<int>(random() % parameter.levels.size()));
  }
  return values;
}

double mean_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
  return sum / static_cast<double>(a.pixels.size());
}

Image preview(const Gl& gl, const MaterialMaps& maps, DisplayCurve curve) {
  SurfaceRenderer renderer(gl);
  renderer.set_maps(maps);
  renderer.render({curve});
  return renderer.read();
}

class PreviewTest : public GlTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(PreviewTest, EqualsTheEnginesRenderAtDrawsFromThePrior) {
  const Renderer engine(GetParam(), 1, Capture{});
  std::mt19937 random(5);
  for (const int resolution : {256, 256, 512}) {
    const ParameterValues values = prior_draw(engine.table(), random);
    const MaterialMaps maps = engine.maps(values, resolution);
    for (const DisplayCurve curve : {DisplayCurve::srgb, DisplayCurve::gamma22}) {
      const double difference =
          mean_difference(preview(gl(), maps, curve), engine.render(values, resolution, curve));
      EXPECT_LT(difference, kTolerance) << resolution << " pixels";
    }
  }
}

TEST_P(PreviewTest, WouldNotEqualTheRenderOfAnotherRoughnessOrBase) {
  const Renderer engine(GetParam(), 1, Capture{});
  const ParameterValues values = prior_location(engine.table());
  MaterialMaps maps = engine.maps(values, 256);
  for (LobeMaps& lobe : maps.lobes) {
    for (float& roughness : lobe.roughness.pixels) roughness = std::clamp(roughness * 0.95f, 0.05f, 1.0f);
  }
  if (maps.lobes.empty())
    for (float& colour : maps.base_color.pixels) colour *= 0.95f;
  EXPECT_GT(mean_difference(preview(gl(), maps, DisplayCurve::srgb), engine.render(values, 256)), kTolerance);
}

INSTANTIATE_TEST_SUITE_P(Materials, PreviewTest, ::testing::ValuesIn(material_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace patina
