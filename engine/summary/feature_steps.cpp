#include "engine/summary/feature_steps.h"

#include <ATen/Context.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/conv2d.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/mkldnn_convolution.h>
#include <ATen/ops/relu.h>
#include <torch/csrc/autograd/custom_function.h>

#include <stdexcept>

#include "engine/summary/feature_kernel.h"
#include "engine/summary/library_steps.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

constexpr auto kChannelsLast = at::MemoryFormat::ChannelsLast;

at::Tensor empty_map(const at::Tensor& like, std::int64_t channels, std::int64_t rows, std::int64_t columns) {
  return at::empty({like.size(0), channels, rows, columns}, like.options().memory_format(kChannelsLast));
}

features::Shape shape_of(const at::Tensor& x) { return {x.size(2), x.size(3), x.size(1)}; }

/// Image by image: with channels last, they lie one after the other.
template <typename Step>
void each_image(const at::Tensor& from, const at::Tensor& to, Step&& step) {
  for (std::int64_t i = 0; i < from.size(0); ++i)
    step(from.data_ptr<float>() + i * shape_of(from).size(), to.data_ptr<float>() + i * shape_of(to).size());
}

/// In the weight's precision, to float32. Left to itself, the library takes small maps apart by a slow path
/// that leaves channels-last.
at::Tensor library_convolution(const at::Tensor& map, const at::Tensor& weight, const at::Tensor& bias,
                               std::int64_t padding) {
  const at::Tensor x = map.to(weight.scalar_type());
  if (at::globalContext().hasMKLDNN() && at::globalContext().userEnabledMkldnn())
    return at::mkldnn_convolution(x, weight, bias, {padding, padding}, {1, 1}, {1, 1}, 1).to(at::kFloat);
  return at::conv2d(x, weight, bias, 1, padding).to(at::kFloat);
}

at::ScalarType scalar_type(Precision precision) {
  return precision == Precision::bfloat16 ? at::kBFloat16 : at::kFloat;
}

at::Tensor reflected(const at::Tensor& x, std::int64_t border) {
  if (border >= x.size(2) || border >= x.size(3))
    throw std::invalid_argument("a feature map is too small to be continued by reflection");
  const at::Tensor wider = empty_map(x, x.size(1), x.size(2) + 2 * border, x.size(3) + 2 * border);
  each_image(x, wider,
             [&](const float* from, float* to) { features::reflect(from, shape_of(x), border, to); });
  return wider;
}

bool by_reflection(const FrozenConvolution& convolution) {
  return convolution.reflect && convolution.border() > 0;
}

std::int64_t zeros_on_each_side(const FrozenConvolution& convolution) {
  return by_reflection(convolution) ? 0 : convolution.border();
}

/// Of a map that has its border.
at::Tensor rectified_convolution(const FrozenConvolution& convolution, const at::Tensor& x) {
  if (convolution.packed) return convolution.packed->of(x);
  at::Tensor y =
      library_convolution(x, convolution.weight, convolution.bias, zeros_on_each_side(convolution));
  return convolution.relu ? y.relu_() : y;
}

struct Convolve : torch::autograd::Function<Convolve> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& map,
                            const FrozenConvolution& convolution) {
    const at::Tensor x = map.contiguous(kChannelsLast);
    const bool wider = by_reflection(convolution);
    const at::Tensor y = rectified_convolution(convolution, wider ? reflected(x, convolution.border()) : x)
                             .contiguous(kChannelsLast);
    context->save_for_backward({convolution.mirrored, convolution.relu ? y : at::Tensor()});
    context->saved_data["border"] = wider ? convolution.border() : 0;
    return y;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &mirrored = saved[0], &y = saved[1];
    at::Tensor gradient = outputs.front().contiguous(kChannelsLast);
    if (y.defined()) {
      const at::Tensor through = empty_map(gradient, y.size(1), y.size(2), y.size(3));
      features::rectify_backward(gradient.data_ptr<float>(), y.data_ptr<float>(), y.numel(),
                                 through.data_ptr<float>());
      gradient = through;
    }
    const std::int64_t border = context->saved_data["border"].toInt(), reach = mirrored.size(2) / 2;
    // With padding the adjoint keeps the size; without, it gives back the border that the map lost.
    const at::Tensor by_input = library_convolution(gradient, mirrored, {}, border > 0 ? 2 * reach : reach);
    if (border == 0) return {by_input, {}};
    const at::Tensor by_map = empty_map(gradient, by_input.size(1), gradient.size(2), gradient.size(3));
    const at::Tensor dense = by_input.contiguous(kChannelsLast);
    each_image(dense, by_map, [&](const float* from, float* to) {
      features::reflect_backward(from, shape_of(by_map), border, to);
    });
    return {by_map, {}};
  }
};

struct AveragePool : torch::autograd::Function<AveragePool> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& map) {
    const at::Tensor x = map.contiguous(kChannelsLast);
    const at::Tensor half = empty_map(x, x.size(1), x.size(2) / 2, x.size(3) / 2);
    each_image(x, half, [&](const float* from, float* to) { features::halve(from, shape_of(x), to); });
    context->saved_data["rows"] = x.size(2);
    context->saved_data["columns"] = x.size(3);
    return half;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const at::Tensor gradient = outputs.front().contiguous(kChannelsLast);
    const at::Tensor by_map = empty_map(gradient, gradient.size(1), context->saved_data["rows"].toInt(),
                                        context->saved_data["columns"].toInt());
    each_image(gradient, by_map,
               [&](const float* from, float* to) { features::halve_backward(from, shape_of(by_map), to); });
    return {by_map};
  }
};

}  // namespace

FrozenConvolution::FrozenConvolution(const at::Tensor& w, const at::Tensor& b, bool with_relu,
                                     bool with_reflection, Precision precision)
    : weight(w.to(scalar_type(precision))),
      bias(b.to(scalar_type(precision))),
      mirrored(weight.flip({2, 3}).transpose(0, 1).contiguous()),
      relu(with_relu),
      reflect(with_reflection),
      packed(PackedConvolution::make(weight, bias, relu, zeros_on_each_side(*this))) {}

at::Tensor convolve(const FrozenConvolution& convolution, const at::Tensor& x) {
  if (!x.is_cpu()) return convolve_by_library(convolution, x);
  return Convolve::apply(x, convolution);
}

at::Tensor average_pool(const at::Tensor& x) {
  if (!x.is_cpu()) return average_pool_by_library(x);
  if (x.is_contiguous(kChannelsLast) || !x.is_contiguous()) return AveragePool::apply(x);
  const at::Tensor planes = x.flatten(0, 1).unsqueeze(1);  // whose only channel is the last one, too
  return AveragePool::apply(planes).view({x.size(0), x.size(1), x.size(2) / 2, x.size(3) / 2});
}

}  // namespace patina
