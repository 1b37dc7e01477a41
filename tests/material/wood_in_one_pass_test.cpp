#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/full.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine/material/growth_rings.h"
#include "engine/material/wood_finish.h"
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

/// Inputs: colours, height and roughnesses, ratio, exponent. One field of all that comes of them.
template <class F>
at::Tensor finish(const F& of, const Inputs& i) {
  const at::Tensor grain =
      at::arange(i[3].numel(), i[3].options().requires_grad(false)).view(i[3].sizes()).sin();
  const WoodFinish made = of({i[0], i[1], i[2][0], i[2][1], i[2][2]}, i[3], i[4], grain, 0.1);
  return at::cat({made.color.flatten(), made.height.flatten(), made.roughness.flatten()});
}

TEST(WoodFinishInOnePass, EqualsTensorOperationsWithItsGradient) {
  const auto square = [](const at::Tensor& field, int side) {
    return field.flatten().narrow(0, 0, side * side).view({side, side});
  };
  for (const double roughness : {0.3, 0.9})  // always below 1, and cut off in places
    expect_same([](const Inputs& i) { return finish(wood_finish, i); },
                [](const Inputs& i) { return finish(wood_finish_by_tensors, i); },
                {numbers({0.8, 0.5, 0.03}), numbers({0.3, 0.45, 0.002}), numbers({0.7, roughness, 0.21}),
                 square(places(0.37, 0).sin().square(), 38), square(places(0.11, 1).cos() * 0.7 + 1.2, 37)});
}

TEST(RingsInOnePass, OfAPlaceThatIsNoNumberAreNone) {
  const at::Tensor profile = numbers({0.2, 0.2, 0.5}).to(at::kFloat), width = at::full({1, 1}, 0.1F);
  const at::Tensor nowhere = at::full({1, 1}, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(latewood_ratio({profile[0], profile[1], profile[2]}, nowhere, width).isnan().item<bool>());
}

TEST(WoodFinishInOnePass, OfBlackWoodIsBlackWithANumberForItsGradient) {
  const at::Tensor black = at::full({3}, 0.0F).set_requires_grad(true), ratio = at::full({3, 3}, 0.5F),
                   one = at::full({}, 1.0F);
  const WoodFinish made = wood_finish({black, black, one, one, one}, ratio, at::full({2, 2}, 1.0F), ratio, 0);
  made.color.sum().backward();
  EXPECT_LT(made.color.max().item<float>(), 1e-6F);
  EXPECT_TRUE(black.grad().isfinite().all().item<bool>());
}

}  // namespace
}  // namespace patina
