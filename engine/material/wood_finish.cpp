#include "engine/material/wood_finish.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/hardtanh.h>
#include <ATen/ops/lerp.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/stack.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <vector>

#include "engine/material/image_planes.h"
#include "engine/material/look_up.h"
#include "engine/material/pixel_blocks.h"
#include "engine/material/wood_kernel.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// @param numbers  [9], in the order of wood::Contrast
wood::Contrast contrast_of(const at::Tensor& numbers) {
  const float* n = numbers.data_ptr<float>();
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6], n[7], n[8]};
}

wood::LatewoodField field_of(const at::Tensor& ratio, const at::Tensor& exponent) {
  return {ratio.data_ptr<float>(), exponent.data_ptr<float>(), exponent.size(0)};
}

struct Finish : torch::autograd::Function<Finish> {
  static variable_list forward(AutogradContext* context, const at::Tensor& numbers, const at::Tensor& ratio,
                               const at::Tensor& exponent, const at::Tensor& grain, double grain_cm) {
    const std::int64_t n = exponent.size(0);
    const at::Tensor color = at::empty({3, n, n}, ratio.options()), height = at::empty_like(ratio),
                     roughness = at::empty_like(exponent);
    const wood::Grain of_all_wood{grain.data_ptr<float>(), static_cast<float>(grain_cm)};
    over_blocks(n + 1, rows_of_a_block(n + 1), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      wood::finish(contrast_of(numbers), field_of(ratio, exponent), of_all_wood, begin, end,
                   {planes_of(color), height.data_ptr<float>(), roughness.data_ptr<float>()});
    });
    context->save_for_backward({numbers, ratio, exponent, color});
    return {color, height, roughness};
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &numbers = saved[0], &ratio = saved[1], &exponent = saved[2];
    const at::Tensor by_color = outputs[0].contiguous(), by_height = outputs[1].contiguous(),
                     by_roughness = outputs[2].contiguous();
    const at::Tensor by_numbers = at::empty_like(numbers), by_ratio = at::empty_like(ratio),
                     by_exponent = at::empty_like(exponent);
    const std::int64_t side = ratio.size(0);
    const std::vector<double> sums = sums_over_blocks(
        side, rows_of_a_block(side), wood::kContrastNumbers,
        [&](std::int64_t begin, std::int64_t end, double* of_block) {
          wood::finish_backward(
              contrast_of(numbers), field_of(ratio, exponent), const_planes_of(saved[3]), begin, end,
              {const_planes_of(by_color), by_height.data_ptr<float>(), by_roughness.data_ptr<float>()},
              {by_ratio.data_ptr<float>(), by_exponent.data_ptr<float>(), of_block});
        });
    std::ranges::copy(sums, by_numbers.data_ptr<float>());
    return {by_numbers, by_ratio, by_exponent, {}, {}};
  }
};

}  // namespace

WoodFinish wood_finish(const LatewoodContrast& contrast, const at::Tensor& ratio, const at::Tensor& exponent,
                       const at::Tensor& grain, double grain_cm) {
  if (ratio.scalar_type() != at::kFloat)
    return wood_finish_by_tensors(contrast, ratio, exponent, grain, grain_cm);
  const at::Tensor numbers = at::cat({contrast.earlywood, contrast.latewood,
                                      at::stack({contrast.latewood_height, contrast.latewood_roughness,
                                                 contrast.earlywood_roughness_more})});
  const variable_list made =
      Finish::apply(numbers, ratio.contiguous(), exponent.contiguous(), grain.contiguous(), grain_cm);
  return {made[0], made[1], made[2]};
}

WoodFinish wood_finish_by_tensors(const LatewoodContrast& contrast, const at::Tensor& ratio,
                                  const at::Tensor& exponent, const at::Tensor& grain, double grain_cm) {
  const at::Tensor here = without_neighbours(ratio);
  // A power is written exp(k log x), whose gradient costs no second power.
  const at::Tensor mixed =
      at::lerp(contrast.earlywood.view({3, 1, 1}), contrast.latewood.view({3, 1, 1}), here);
  const at::Tensor roughness =
      contrast.latewood_roughness + at::rsub(here, 1) * contrast.earlywood_roughness_more;
  return {(mixed.log() * exponent).exp(), ratio * contrast.latewood_height + grain_cm * grain,
          at::hardtanh(roughness, 0, 1)};
}

}  // namespace patina
