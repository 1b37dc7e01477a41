#include "engine/material/leather_finish.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/hardtanh.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/stack.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <vector>

#include "engine/material/leather_kernel.h"
#include "engine/material/look_up.h"
#include "engine/material/pixel_blocks.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

struct FinishOfLeather : torch::autograd::Function<FinishOfLeather> {
  static variable_list forward(AutogradContext* context, const at::Tensor& numbers, const at::Tensor& maps) {
    const leather::Maps at = maps_of(maps);
    const at::Tensor height = at::empty({at.side + 1, at.side + 1}, maps.options()),
                     roughness = at::empty({at.side, at.side}, maps.options());
    over_blocks(at.side + 1, rows_of_a_block(at.side + 1),
                [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                  leather::finish(relief_of(numbers), at, begin, end, height.data_ptr<float>(),
                                  roughness.data_ptr<float>());
                });
    context->save_for_backward({numbers, maps});
    return {height, roughness};
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const leather::Maps at = maps_of(saved[1]);
    const at::Tensor by_height = outputs[0].contiguous(), by_roughness = outputs[1].contiguous();
    const at::Tensor by_numbers = at::empty_like(saved[0]), by_maps = at::empty_like(saved[1]);
    float* by_cells = by_maps.data_ptr<float>();
    const std::vector<double> sums = sums_over_blocks(
        at.side + 1, rows_of_a_block(at.side + 1), leather::kReliefNumbers,
        [&](std::int64_t begin, std::int64_t end, double* of_block) {
          leather::finish_backward(relief_of(saved[0]), at, begin, end, by_height.data_ptr<float>(),
                                   by_roughness.data_ptr<float>(),
                                   {by_cells, by_cells + by_height.numel(), of_block});
        });
    std::ranges::copy(sums, by_numbers.data_ptr<float>());
    return {by_numbers, by_maps};
  }

 private:
  /// @param numbers  [5], in the order of leather::Relief
  static leather::Relief relief_of(const at::Tensor& numbers) {
    const float* n = numbers.data_ptr<float>();
    return {n[0], n[1], n[2], n[3], n[4]};
  }

  static leather::Maps maps_of(const at::Tensor& maps) {
    const float* cells = maps.data_ptr<float>();
    return {cells, cells + maps.size(1) * maps.size(2), maps.size(1) - 1};
  }
};

}  // namespace

LeatherFinish leather_finish(const LeatherRelief& relief, const at::Tensor& maps) {
  if (maps.scalar_type() != at::kFloat) return leather_finish_by_tensors(relief, maps);
  const at::Tensor numbers = at::stack(
      {relief.height, relief.power, relief.noise_scale, relief.roughness, relief.roughness_variation});
  const variable_list made = FinishOfLeather::apply(numbers, maps.contiguous());
  return {made[0], made[1]};
}

LeatherFinish leather_finish_by_tensors(const LeatherRelief& relief, const at::Tensor& maps) {
  const at::Tensor cells = without_neighbours(maps[0]);
  const at::Tensor raised = (maps[0].log() * relief.power).exp();
  const at::Tensor roughness = relief.roughness + at::rsub(cells, 1) * relief.roughness_variation;
  return {at::hardtanh(relief.height * raised, 0, 1) + relief.noise_scale * (2 * maps[1] - 1),
          at::hardtanh(roughness, leather::kLeastRoughness, leather::kMostRoughness)};
}

}  // namespace patina
