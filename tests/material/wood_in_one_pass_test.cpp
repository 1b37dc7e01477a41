#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/full.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine/material/growth_rings.h"
#include "engine/material/wood_color.h"
#include "one_pass.h"

namespace patina {
namespace {

using Inputs = std::vector<at::Tensor>;

at::Tensor numbers(std::initializer_list<double> values) { return at::tensor(values, at::kDouble); }

TEST(RingsInOnePass, EqualTensorOperationsWithTheirGradientAtEveryWidth) {
  const auto fused = [](const Inputs& i) { return latewood_ratio({i[0][0], i[0][1], i[0][2]}, i[1], i[2]); };
  const auto by_tensors = [](const Inputs& i) {
    return latewood_ratio_by_tensors({i[0][0], i[0][1], i[0][2]}, i[1], i[2]);
  };
  // Ramps that end before the next ring or not, that meet before the top, and steep ones.
  for (const at::Tensor& profile :
       {numbers({0.2, 0.2, 0.5}), numbers({0.4, 0.1, 0.1}), numbers({0.2, 0.4, 0.9}),
        numbers({0.4, 0.4, 0.35}), numbers({0.05, 0.06, 0.5})})
    for (const double width : {0.07, 0.3, 0.61, 0.87, 1.3}) {
      SCOPED_TRACE(testing::Message() << width);
      const at::Tensor widths = places(0.00001, 0).cos() * width;
      expect_same(fused, by_tensors, {profile, places(0.00517, -3.0071), widths}, 1e-3);
    }
}

TEST(RingWidthsInOnePass, EqualTensorOperationsWithTheirGradient) {
  const at::Tensor bent = places(0.05, -20).sin() * places(0.013, 2);
  expect_same([](const Inputs& i) { return ring_widths(i[0]); },
              [](const Inputs& i) { return ring_widths_by_tensors(i[0]); }, {bent});
}

TEST(WoodColorInOnePass, EqualsTensorOperationsWithItsGradient) {
  expect_same([](const Inputs& i) { return wood_color(i[0], i[1], i[2], i[3]); },
              [](const Inputs& i) { return wood_color_by_tensors(i[0], i[1], i[2], i[3]); },
              {numbers({0.8, 0.5, 0.03}), numbers({0.3, 0.45, 0.002}), places(0.37, 0).sin().square(),
               places(0.11, 1).cos() * 0.7 + 1.2});
}

TEST(RingsInOnePass, OfAPlaceThatIsNoNumberAreNone) {
  const at::Tensor profile = numbers({0.2, 0.2, 0.5}).to(at::kFloat), width = at::full({1, 1}, 0.1F);
  const at::Tensor nowhere = at::full({1, 1}, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(latewood_ratio({profile[0], profile[1], profile[2]}, nowhere, width).isnan().item<bool>());
}

TEST(WoodColorInOnePass, OfBlackWoodIsBlackWithANumberForItsGradient) {
  const at::Tensor black = at::full({3}, 0.0F).set_requires_grad(true), ratio = at::full({2, 2}, 0.5F);
  const at::Tensor color = wood_color(black, black, ratio, ratio * 2);
  color.sum().backward();
  EXPECT_LT(color.max().item<float>(), 1e-6F);
  EXPECT_TRUE(black.grad().isfinite().all().item<bool>());
}

}  // namespace
}  // namespace patina
