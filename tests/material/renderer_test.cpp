#include "engine/material/renderer.h"
#include "engine/material/shading.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/from_blob.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/error.h"
#include "materials_fixture.h"

namespace patina {
namespace {

at::Tensor planes_of(const Image& image) {
  return at::from_blob(const_cast<float*>(image.pixels.data()), {image.height, image.width, image.channels})
      .permute({2, 0, 1})
      .clone();
}

at::Tensor float_scalar(double x) { return at::tensor(x, at::kFloat); }

class EveryRenderer : public testing::TestWithParam<std::string> {
 protected:
  Renderer renderer{GetParam(), 11, Capture{}};
  ParameterValues values = prior_location(renderer.table());
};

TEST_P(EveryRenderer, RenderIsTheForwardModelAsAnImage) {
  const Image image = renderer.render(values, 64);
  ASSERT_EQ(image.width, 64);
  ASSERT_EQ(image.height, 64);
  ASSERT_EQ(image.channels, 3);
  const at::Tensor expected =
      render(*make_material(GetParam()), tensor_of(values.continuous, at::kFloat), values.discrete, 64);
  EXPECT_TRUE(planes_of(image).equal(expected));
}

TEST_P(EveryRenderer, MapsShadedAgainAreTheRender) {
  const MaterialMaps maps = renderer.maps(values, 64);
  Surface surface;
  surface.base_color = planes_of(maps.base_color);
  surface.normal = planes_of(maps.normal);
  for (const LobeMaps& lobe : maps.lobes) {
    const at::Tensor roughness = planes_of(lobe.roughness);
    surface.lobes.push_back({planes_of(lobe.normal),
                             at::tensor(std::vector<float>(lobe.f0.begin(), lobe.f0.end())), roughness[0],
                             roughness[1]});
  }
  surface.light = float_scalar(maps.light);
  surface.vignette_sigma = float_scalar(maps.vignette_sigma);
  const at::Tensor again = display(shade(surface, maps.capture, 64), DisplayCurve::srgb);
  EXPECT_LT((again - planes_of(renderer.render(values, 64))).abs().max().item<float>(), 1e-4);
  EXPECT_EQ(maps.height.channels, 1);
  EXPECT_EQ(maps.resolution(), 64);
}

TEST_P(EveryRenderer, RefusesResolutionsItIsNotMadeFor) {
  for (const int resolution : {-1, 0, 15, 4097}) {
    EXPECT_THROW(renderer.render(values, resolution), UserError);
    EXPECT_THROW(renderer.maps(values, resolution), UserError);
  }
  EXPECT_NO_THROW(renderer.render(values, 17));
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryRenderer, testing::ValuesIn(material_names()),
                         [](const auto& info) { return info.param; });

TEST(RendererOfAnUnknownMaterial, IsRefused) { EXPECT_THROW(Renderer("velvet", 1, Capture{}), UserError); }

}  // namespace
}  // namespace patina
