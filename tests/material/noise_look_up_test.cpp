#include <ATen/ops/full.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine/material/rings_from_pith.h"
#include "engine/material/value_noise.h"
#include "engine/material/wood_streaks.h"
#include "one_pass.h"

namespace patina {
namespace {

TEST(RingsFromPithInOnePass, EqualTensorOperationsWithTheirGradientAtEveryMixtureOfLevels) {
  using Inputs = std::vector<at::Tensor>;
  const ValueNoise noise = make_value_noise(3, 1, 1, 64);
  for (const double pixel_cm : {0.02, 0.9, 2.7, 300.0}) {
    SCOPED_TRACE(testing::Message() << pixel_cm);
    expect_same(
        [&](const Inputs& i) {
          return rings_from_pith({i[0], i[1]}, {i[2], i[3], i[4]}, noise, pixel_cm);
        },
        [&](const Inputs& i) {
          return rings_from_pith_by_tensors({i[0], i[1]}, {i[2], i[3], i[4]}, noise, pixel_cm);
        },
        {places(0.0517, -31.013), places(-0.0311, 7.017), at::tensor(1.37, at::kDouble),
         at::tensor(0.83, at::kDouble), at::tensor(0.61, at::kDouble)});
  }
}

TEST(StreaksInOnePass, EqualTensorOperationsWithTheirGradientAtEveryMixtureOfLevels) {
  using Inputs = std::vector<at::Tensor>;
  const ValueNoise noise = make_value_noise(3, 1, 32, 64);
  const auto square = [](double step, double begin) {
    return at::arange(39 * 39, at::kDouble).view({39, 39}) * step + begin;
  };
  for (const double width_x : {0.2, 2.3, 300.0})
    for (const double width_y : {0.2, 5.1}) {
      SCOPED_TRACE(testing::Message() << width_x << " x " << width_y);
      const auto exponent = [&](const auto& of, const Inputs& i) {
        return of({i[0], i[1]}, {i[2], i[3], i[4], i[5]}, noise, i[6], i[7]);
      };
      const auto number = [](double x) { return at::tensor(x, at::kDouble); };
      expect_same([&](const Inputs& i) { return exponent(streak_exponent, i); },
                  [&](const Inputs& i) { return exponent(streak_exponent_by_tensors, i); },
                  {square(0.0517, -31.013), square(-0.0311, 7.017), number(1.37), number(0.83), number(0.31),
                   number(-2.1), number(width_x), number(width_y)});
    }
}

TEST(WarpInOnePass, EqualsTensorOperationsWithItsGradient) {
  using Inputs = std::vector<at::Tensor>;
  const at::Tensor volume = make_noise_volume(3, 1, 2, 16);
  const auto both = [](const WarpedGrid& grid) { return at::stack({grid.x, grid.y}); };
  const auto along = [](double begin, double step, int count) {
    return at::arange(count, at::kDouble) * step + begin;
  };
  for (const double scale : {0.31, 4.7, 55.1})  // within a lattice cell, across some, and across periods
    expect_same(
        [&](const Inputs& i) { return both(warp_grid(volume, i[0], i[1], i[2], i[3], i[4])); },
        [&](const Inputs& i) { return both(warp_grid_by_tensors(volume, i[0], i[1], i[2], i[3], i[4])); },
        {along(-3.0131, 0.1717, 37), along(2.017, -0.0911, 41), along(0.519, 0.0733, 41),
         at::tensor(scale, at::kDouble), at::tensor(0.83, at::kDouble)});
}

TEST(NoiseInOnePass, OfAPlaceThatIsNoNumberIsNone) {
  const at::Tensor volume = make_noise_volume(3, 1, 2, 16), one = at::full({1, 1}, 0.3F);
  const ValueNoise noise = make_value_noise(3, 1, 32, 32), along_x = make_value_noise(3, 1, 1, 32);
  for (const float odd :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30F}) {
    const at::Tensor place = at::full({1, 1}, odd);
    // None reads outside the lattice.
    rings_from_pith({place, one}, {one[0][0], one[0][0], one[0][0]}, along_x, 0.1);
    const at::Tensor grid = at::full({2, 2}, odd), number = one[0][0];
    streak_exponent({grid, grid}, {number, number, number, number}, noise, number, number);
    warp_grid(volume, one[0], place[0], one[0], one[0][0], one[0][0]);
  }
  const at::Tensor nowhere = at::full({1, 1}, std::numeric_limits<float>::quiet_NaN());
  const at::Tensor grid = nowhere.expand({2, 2}), number = one[0][0];
  EXPECT_TRUE(streak_exponent({grid, grid}, {number, number, number, number}, noise, number, number)
                  .isnan()
                  .item<bool>());
  EXPECT_TRUE(
      rings_from_pith({nowhere, one}, {one[0][0], one[0][0], one[0][0]}, along_x, 0.1).isnan().item<bool>());
  EXPECT_TRUE(
      warp_grid(volume, one[0], one[0], nowhere[0], one[0][0], one[0][0]).x.isnan().all().item<bool>());
}

}  // namespace
}  // namespace patina
