#include "engine/summary/library_steps.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/conv2d.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/relu.h>
#include <torch/csrc/autograd/custom_function.h>

#include <array>
#include <stdexcept>

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// One end of an axis of a map with a border: the border, and the places that it mirrors.
struct End {
  at::Tensor border, mirrored;
};

std::array<End, 2> ends_of(const at::Tensor& wide, std::int64_t axis, std::int64_t border) {
  const std::int64_t side = wide.size(axis) - 2 * border;
  const auto part = [&](std::int64_t begin) { return wide.narrow(axis, begin, border); };
  return {End{part(0), part(border + 1)}, End{part(border + side), part(side - 1)}};
}

/// A map with a border on every side, continued by reflection. Not by reflection_pad2d, whose gradient adds
/// up in any order on a graphics card, so that no two runs would be equal, and which leaves channels-last.
struct Reflect : torch::autograd::Function<Reflect> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& map, std::int64_t border) {
    const std::int64_t rows = map.size(2), columns = map.size(3);
    if (border >= rows || border >= columns)
      throw std::invalid_argument("a feature map is too small to be continued by reflection");
    context->saved_data["border"] = border;
    const at::Tensor wide = at::empty({map.size(0), map.size(1), rows + 2 * border, columns + 2 * border},
                                      map.options().memory_format(at::MemoryFormat::ChannelsLast));
    wide.narrow(2, border, rows).narrow(3, border, columns).copy_(map);
    for (const std::int64_t axis : {2, 3})
      for (const End& end : ends_of(wide, axis, border)) end.border.copy_(end.mirrored.flip(axis));
    return wide;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const std::int64_t border = context->saved_data["border"].toInt();
    const at::Tensor wide = outputs.front().clone();
    for (const std::int64_t axis : {3, 2})
      for (const End& end : ends_of(wide, axis, border)) end.mirrored.add_(end.border.flip(axis));
    return {wide.narrow(2, border, wide.size(2) - 2 * border).narrow(3, border, wide.size(3) - 2 * border),
            {}};
  }
};

}  // namespace

at::Tensor convolve_by_library(const FrozenConvolution& convolution, const at::Tensor& x) {
  const std::int64_t border = convolution.weight.size(2) / 2;
  const bool by_reflection = convolution.reflect && border > 0;
  const at::Tensor map = by_reflection ? Reflect::apply(x, border) : x;
  const at::Tensor y = at::conv2d(map.to(convolution.weight.scalar_type()), convolution.weight,
                                  convolution.bias, 1, by_reflection ? 0 : border)
                           .to(at::kFloat);
  return convolution.relu ? at::relu(y) : y;
}

at::Tensor average_pool_by_library(const at::Tensor& x) { return at::avg_pool2d(x, {2, 2}); }

}  // namespace patina
