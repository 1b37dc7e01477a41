#include "engine/material/look_up.h"

#include <ATen/Context.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/rand.h>
#include <ATen/ops/scalar_tensor.h>
#include <gtest/gtest.h>

#include <vector>

namespace patina {
namespace {

using LookUpFunction = at::Tensor (*)(const MipMap&, const at::Tensor&, const at::Tensor&, const at::Tensor&,
                                      int, Neighbours);

/// What a look-up says, and the gradient of a weighted sum of it by scale and shifts.
std::vector<at::Tensor> looked(LookUpFunction look_up, const MipMap& map, double scale, int resolution,
                               at::ScalarType type) {
  const auto leaf = [&](double value) {
    return at::scalar_tensor(value, at::kFloat).to(type).detach().set_requires_grad(true);
  };
  const at::Tensor s = leaf(scale), x = leaf(0.137), y = leaf(-0.771);
  const at::Tensor planes = look_up(map, s, x, y, resolution, Neighbours::above_and_right);
  planes.backward(at::arange(planes.numel(), planes.options()).view(planes.sizes()).sin());
  return {planes.detach(), s.grad(), x.grad(), y.grad()};
}

class LookUpInOnePass : public testing::TestWithParam<double> {};

TEST_P(LookUpInOnePass, EqualsTensorOperationsWithItsGradient) {
  at::manual_seed(7);
  for (const std::int64_t channels : {1, 3}) {
    const MipMap map = make_mip_map(at::rand({1, channels, 64, 64}));
    constexpr int kResolution = 45;  // no multiple of the pixels that are taken at once
    const auto fused = looked(look_up, map, GetParam(), kResolution, at::kFloat),
               reference = looked(look_up_by_tensors, map, GetParam(), kResolution, at::kDouble);
    for (std::size_t i = 0; i < fused.size(); ++i) {
      const double size = reference[i].abs().max().item<double>();
      EXPECT_LT((fused[i].to(at::kDouble) - reference[i]).abs().max().item<double>(), 1e-3 * size + 1e-6)
          << "quantity " << i << " of " << channels << " channels";
    }
  }
}

// Magnified, at and between levels, and beyond the coarsest.
INSTANTIATE_TEST_SUITE_P(Scales, LookUpInOnePass, testing::Values(0.21, 0.93, 1.7, 4.4, 30.0));

TEST(LookUpWithoutNeighbours, IsThePixelsAlone) {
  const MipMap map = make_mip_map(at::rand({1, 2, 64, 64}));
  const at::Tensor scale = at::scalar_tensor(1.3F), x = at::scalar_tensor(0.2F), y = at::scalar_tensor(-0.4F);
  const at::Tensor pixels = look_up(map, scale, x, y, 45, Neighbours::none);
  EXPECT_LT((pixels - without_neighbours(look_up(map, scale, x, y, 45))).abs().max().item<float>(), 1e-6F);
}

}  // namespace
}  // namespace patina
