#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/full.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine/material/value_noise.h"

namespace patina {
namespace {

/// A value of the noise and its gradient by every input, given a gradient by the values that differs from
/// pixel to pixel.
struct Looked {
  at::Tensor value;
  std::vector<at::Tensor> gradients;
};

template <class F>
Looked looked(const F& look_up, const std::vector<at::Tensor>& inputs, at::ScalarType type) {
  std::vector<at::Tensor> leaves;
  for (const at::Tensor& input : inputs)
    leaves.push_back(input.to(at::kFloat).to(type).detach().set_requires_grad(true));
  const at::Tensor value = look_up(leaves);
  value.backward(at::arange(value.numel(), value.options()).view(value.sizes()).sin());
  Looked result{value.detach(), {}};
  for (const at::Tensor& leaf : leaves) result.gradients.push_back(leaf.grad());
  return result;
}

/// Of values and gradients, relative to the largest.
double difference(const at::Tensor& a, const at::Tensor& b) {
  const double size = 1e-6 + b.abs().max().item<double>();
  return (a.to(at::kDouble) - b).abs().max().item<double>() / size;
}

template <class F, class G>
void expect_same(const F& in_one_pass, const G& by_tensors, const std::vector<at::Tensor>& inputs) {
  const Looked fused = looked(in_one_pass, inputs, at::kFloat),
               reference = looked(by_tensors, inputs, at::kDouble);
  EXPECT_LT(difference(fused.value, reference.value), 2e-5);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!reference.gradients[i].defined() || reference.gradients[i].abs().max().item<double>() == 0) continue;
    ASSERT_TRUE(fused.gradients[i].defined()) << "input " << i;
    EXPECT_LT(difference(fused.gradients[i], reference.gradients[i]), 2e-4) << "input " << i;
  }
}

/// Neither a multiple of the pixels that are taken at once nor within one period; no pixel on the lattice.
at::Tensor places(double step, double begin) {
  return at::arange(37 * 41, at::kDouble).view({37, 41}) * step + begin;
}

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
