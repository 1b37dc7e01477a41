#include "engine/summary/library_steps.h"

#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/conv2d.h>
#include <ATen/ops/relu.h>

#include <stdexcept>

namespace patina {
namespace {

/// Continued by reflection along an axis. Not by reflection_pad2d, whose gradient adds up in any order on a
/// graphics card, so that no two runs would be equal.
at::Tensor reflected(const at::Tensor& x, std::int64_t axis, std::int64_t border) {
  const std::int64_t side = x.size(axis);
  if (border >= side) throw std::invalid_argument("a feature map is too small to be continued by reflection");
  return at::cat(
      {x.narrow(axis, 1, border).flip(axis), x, x.narrow(axis, side - 1 - border, border).flip(axis)}, axis);
}

}  // namespace

at::Tensor convolve_by_library(const FrozenConvolution& convolution, const at::Tensor& x) {
  const std::int64_t border = convolution.weight.size(2) / 2;
  const bool by_reflection = convolution.reflect && border > 0;
  const at::Tensor map = by_reflection ? reflected(reflected(x, 2, border), 3, border) : x;
  const at::Tensor y = at::conv2d(map.to(convolution.weight.scalar_type()), convolution.weight,
                                  convolution.bias, 1, by_reflection ? 0 : border)
                           .to(at::kFloat);
  return convolution.relu ? at::relu(y) : y;
}

at::Tensor average_pool_by_library(const at::Tensor& x) { return at::avg_pool2d(x, {2, 2}); }

}  // namespace patina
