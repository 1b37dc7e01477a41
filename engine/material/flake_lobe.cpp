#include "engine/material/flake_lobe.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/stack.h>
#include <torch/csrc/autograd/custom_function.h>

#include <vector>

#include "engine/material/flake_kernel.h"
#include "engine/material/image_planes.h"
#include "engine/material/pixel_blocks.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

flake::Lobe lobe_of(const at::Tensor& normal, const at::Tensor& roughness) {
  return {const_planes_of(normal), roughness.data_ptr<float>()};
}

flake::Gloss gloss_of(const at::Tensor& steepness, const at::Tensor& square_alpha) {
  return {*steepness.data_ptr<float>(), *square_alpha.data_ptr<float>()};
}

/// Normals and roughness.
struct FlakeLobe : torch::autograd::Function<FlakeLobe> {
  static variable_list forward(AutogradContext* context, const at::Tensor& flakes,
                               const at::Tensor& steepness, const at::Tensor& square_alpha) {
    const at::Tensor normal = at::empty_like(flakes),
                     roughness = at::empty({flakes.size(1), flakes.size(2)}, flakes.options());
    const flake::Gloss gloss = gloss_of(steepness, square_alpha);
    over_blocks(roughness.numel(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      flake::lobe(gloss, const_planes_of(flakes), begin, end, planes_of(normal), roughness.data_ptr<float>());
    });
    context->save_for_backward({flakes, steepness, square_alpha, normal, roughness});
    return {normal, roughness};
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &flakes = saved[0], &steepness = saved[1], &square_alpha = saved[2];
    const at::Tensor by_normal = outputs[0].contiguous(), by_roughness = outputs[1].contiguous();
    const at::Tensor by_flakes = at::empty_like(flakes), by_steepness = at::empty_like(steepness),
                     by_square_alpha = at::empty_like(square_alpha);
    const std::vector<double> sums = sums_over_blocks(
        by_roughness.numel(), 2, [&](std::int64_t begin, std::int64_t end, double* by_gloss) {
          flake::lobe_backward(gloss_of(steepness, square_alpha), const_planes_of(flakes),
                               lobe_of(saved[3], saved[4]), lobe_of(by_normal, by_roughness), begin, end,
                               planes_of(by_flakes), by_gloss);
        });
    *by_steepness.data_ptr<float>() = static_cast<float>(sums[0]);
    *by_square_alpha.data_ptr<float>() = static_cast<float>(sums[1]);
    return {by_flakes, by_steepness, by_square_alpha};
  }
};

}  // namespace

Lobe flake_lobe(const at::Tensor& flakes, const at::Tensor& ndf, const at::Tensor& rough,
                const at::Tensor& f0) {
  if (flakes.scalar_type() != at::kFloat) return flake_lobe_by_tensors(flakes, ndf, rough, f0);
  const variable_list made = FlakeLobe::apply(flakes.contiguous(), ndf.square(), rough.square().square());
  return {made[0], f0, made[1], made[1]};
}

Lobe flake_lobe_by_tensors(const at::Tensor& flakes, const at::Tensor& ndf, const at::Tensor& rough,
                           const at::Tensor& f0) {
  const at::Tensor steepness = ndf.square();
  const at::Tensor slopes = flakes.narrow(0, 0, 2) * steepness;
  const at::Tensor up = (slopes.square().sum(0) + 1).rsqrt();
  const at::Tensor square_alpha = rough.square().square() + flakes[2] * (flake::kSpread * steepness.square());
  const at::Tensor roughness = square_alpha.sqrt().sqrt();
  return {at::stack({slopes[0] * up, slopes[1] * up, up}), f0, roughness, roughness};
}

}  // namespace patina
