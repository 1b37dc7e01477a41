#include <ATen/ops/full.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine/material/value_noise.h"
#include "one_pass.h"

namespace patina {
namespace {

TEST(NoiseInOnePass, EqualsTensorOperationsWithItsGradientAtEveryMixtureOfLevels) {
  const auto fused = [](const ValueNoise& noise) {
    return [&](const std::vector<at::Tensor>& i) { return value_noise(noise, i[0], i[1], i[2], i[3]); };
  };
  const auto by_tensors = [](const ValueNoise& noise) {
    return [&](const std::vector<at::Tensor>& i) {
      return value_noise_by_tensors(noise, i[0], i[1], i[2], i[3]);
    };
  };
  const ValueNoise both_ways = make_value_noise(3, 1, 32, 64), along_x = make_value_noise(3, 1, 1, 64);
  for (const ValueNoise* noise : {&both_ways, &along_x})
    for (const double width_x : {0.2, 2.3, 300.0})
      for (const double width_y : {0.2, 5.1}) {
        SCOPED_TRACE(testing::Message() << width_x << " x " << width_y);
        expect_same(fused(*noise), by_tensors(*noise),
                    {places(0.0517, -31.013), places(-0.0311, 7.017), at::tensor(width_x, at::kDouble),
                     at::tensor(width_y, at::kDouble)});
      }
}

TEST(NoiseInOnePass, OfAVolumeEqualsTensorOperationsWithItsGradient) {
  const at::Tensor volume = make_noise_volume(3, 1, 2, 16);
  expect_same(
      [&](const std::vector<at::Tensor>& i) { return volume_noise(volume, i[0], i[1], i[2]); },
      [&](const std::vector<at::Tensor>& i) { return volume_noise_by_tensors(volume, i[0], i[1], i[2]); },
      {places(0.0517, -31.013), places(-0.0311, 7.017), places(0.0173, 0.519)});
}

TEST(NoiseInOnePass, OfAPlaceThatIsNoNumberIsNone) {
  const at::Tensor volume = make_noise_volume(3, 1, 2, 16), one = at::full({1, 1}, 0.3F);
  const ValueNoise noise = make_value_noise(3, 1, 32, 32);
  for (const float odd :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30F}) {
    const at::Tensor place = at::full({1, 1}, odd);
    value_noise(noise, place, one, one[0][0], one[0][0]);  // reads nothing outside the lattice
    volume_noise(volume, one, place, one);
  }
  const at::Tensor nowhere = at::full({1, 1}, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(value_noise(noise, nowhere, one, one[0][0], one[0][0]).isnan().item<bool>());
  EXPECT_TRUE(volume_noise(volume, one, one, nowhere).isnan().all().item<bool>());
}

}  // namespace
}  // namespace patina
