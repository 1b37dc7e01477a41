#include "engine/material/wood_color.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/lerp.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <vector>

#include "engine/material/image_planes.h"
#include "engine/material/pixel_blocks.h"
#include "engine/material/wood_kernel.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

wood::Colour colour_of(const at::Tensor& colour) {
  const float* c = colour.data_ptr<float>();
  return {c[0], c[1], c[2]};
}

struct WoodColor : torch::autograd::Function<WoodColor> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& earlywood, const at::Tensor& latewood,
                            const at::Tensor& ratio, const at::Tensor& exponent) {
    const at::Tensor color = at::empty({3, ratio.size(0), ratio.size(1)}, ratio.options());
    over_blocks(ratio.numel(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      wood::wood_color(colour_of(earlywood), colour_of(latewood), ratio.data_ptr<float>(),
                       exponent.data_ptr<float>(), begin, end, planes_of(color));
    });
    context->save_for_backward({earlywood, latewood, ratio, exponent, color});
    return color;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &earlywood = saved[0], &latewood = saved[1], &ratio = saved[2], &exponent = saved[3];
    const at::Tensor gradient = outputs.front().contiguous();
    const at::Tensor by_earlywood = at::empty_like(earlywood), by_latewood = at::empty_like(latewood),
                     by_ratio = at::empty_like(ratio), by_exponent = at::empty_like(exponent);
    const std::vector<double> sums =
        sums_over_blocks(ratio.numel(), 6, [&](std::int64_t begin, std::int64_t end, double* by_colours) {
          wood::wood_color_backward(colour_of(earlywood), colour_of(latewood), ratio.data_ptr<float>(),
                                    exponent.data_ptr<float>(), begin, end, const_planes_of(saved[4]),
                                    const_planes_of(gradient), by_ratio.data_ptr<float>(),
                                    by_exponent.data_ptr<float>(), by_colours, by_colours + 3);
        });
    std::copy_n(sums.begin(), 3, by_earlywood.data_ptr<float>());
    std::copy_n(sums.begin() + 3, 3, by_latewood.data_ptr<float>());
    return {by_earlywood, by_latewood, by_ratio, by_exponent};
  }
};

}  // namespace

at::Tensor wood_color(const at::Tensor& earlywood, const at::Tensor& latewood, const at::Tensor& ratio,
                      const at::Tensor& exponent) {
  if (ratio.scalar_type() != at::kFloat) return wood_color_by_tensors(earlywood, latewood, ratio, exponent);
  return WoodColor::apply(earlywood.contiguous(), latewood.contiguous(), ratio.contiguous(),
                          exponent.contiguous());
}

at::Tensor wood_color_by_tensors(const at::Tensor& earlywood, const at::Tensor& latewood,
                                 const at::Tensor& ratio, const at::Tensor& exponent) {
  // A power is written exp(k log x), whose gradient costs no second power.
  const at::Tensor mixed = at::lerp(earlywood.view({3, 1, 1}), latewood.view({3, 1, 1}), ratio);
  return (mixed.log() * exponent).exp();
}

}  // namespace patina
