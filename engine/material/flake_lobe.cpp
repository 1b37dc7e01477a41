#include "engine/material/flake_lobe.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/scalar_tensor.h>
#include <ATen/ops/stack.h>
#include <torch/csrc/autograd/custom_function.h>

#include <array>
#include <utility>
#include <vector>

#include "engine/material/flake_kernel.h"
#include "engine/material/image_planes.h"
#include "engine/material/kept.h"
#include "engine/material/look_up_places.h"
#include "engine/material/parameter_tensors.h"
#include "engine/material/pixel_blocks.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

constexpr std::int64_t kRowsAtOnce = 8;

/// @param ndf, rough  as FlakeGloss has them
flake::Gloss gloss_of(const at::Tensor& ndf, const at::Tensor& rough) {
  const double n = number_of(ndf), r = number_of(rough);
  return {static_cast<float>(n * n), static_cast<float>(r * r * r * r)};
}

/// From pixel `first` on.
flake::Lobe lobe_of(const at::Tensor& normal, const at::Tensor& roughness, std::int64_t first) {
  return {from_pixel(const_planes_of(normal), first), roughness.data_ptr<float>() + first};
}

/// Normals and roughness.
struct FlakeLobe : torch::autograd::Function<FlakeLobe> {
  static variable_list forward(AutogradContext* context, const at::Tensor& scale, const at::Tensor& shift_x,
                               const at::Tensor& shift_y, const at::Tensor& ndf, const at::Tensor& rough,
                               const MipMap& map, std::int64_t n) {
    LookUpPlaces places(map, scale, shift_x, shift_y, n, Neighbours::none);
    const mip::Problem problem = places.problem();
    const at::Tensor flakes = at::empty({3, n, n}, scale.options()), normal = at::empty_like(flakes),
                     roughness = at::empty({n, n}, scale.options());
    const flake::Gloss gloss = gloss_of(ndf, rough);
    over_blocks(n, kRowsAtOnce, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      mip::look_up(problem, begin, end, flakes.data_ptr<float>());
      flake::lobe(gloss, const_planes_of(flakes), begin * n, end * n, planes_of(normal),
                  roughness.data_ptr<float>());
    });
    context->save_for_backward({ndf, rough, flakes, normal, roughness});
    context->saved_data["places"] = keep(std::move(places));
    return {normal, roughness};
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &ndf = saved[0], &rough = saved[1], &flakes = saved[2], &normal = saved[3],
                     &roughness = saved[4];
    const auto& places = kept<LookUpPlaces>(context->saved_data["places"]);
    const at::Tensor by_normal = outputs[0].contiguous(), by_roughness = outputs[1].contiguous();
    const std::int64_t n = places.rows();
    const flake::Gloss gloss = gloss_of(ndf, rough);
    std::vector<float> by_rows(static_cast<std::size_t>(n));
    std::vector<mip::Gradient> blocks;
    for (std::int64_t row = 0; row < n; row += kRowsAtOnce)
      blocks.push_back(places.no_gradient(by_rows.data() + row));
    const std::vector<double> by_gloss =
        sums_over_blocks(n, kRowsAtOnce, 2, [&](std::int64_t begin, std::int64_t end, double* sums) {
          const std::int64_t first = begin * n, pixels = (end - begin) * n;
          std::vector<float> by_flakes(static_cast<std::size_t>(3 * pixels));
          float* by = by_flakes.data();
          flake::lobe_backward(gloss, from_pixel(const_planes_of(flakes), first),
                               lobe_of(normal, roughness, first), lobe_of(by_normal, by_roughness, first), 0,
                               pixels, {by, by + pixels, by + 2 * pixels}, sums);
          mip::look_up_backward(places.problem(begin, end), 0, end - begin, by,
                                blocks[static_cast<std::size_t>(begin / kRowsAtOnce)]);
        });

    const std::array<double, 3> by_place = places.gradient(blocks, by_rows);
    const double r = number_of(rough);
    variable_list gradient;
    for (const double by : {by_place[0], by_place[1], by_place[2], by_gloss[0] * 2 * number_of(ndf),
                            by_gloss[1] * 4 * r * r * r})
      gradient.push_back(at::scalar_tensor(by, ndf.options()));
    gradient.resize(7);  // nothing for what are no tensors
    return gradient;
  }
};

}  // namespace

Lobe flake_lobe(const MipMap& flakes, const FlakePlace& place, const FlakeGloss& gloss, int n) {
  if (gloss.rough.scalar_type() != at::kFloat) return flake_lobe_by_tensors(flakes, place, gloss, n);
  const variable_list made = FlakeLobe::apply(place.scale, place.shift_x, place.shift_y, gloss.ndf,
                                              gloss.rough, flakes, static_cast<std::int64_t>(n));
  return {made[0], gloss.f0, made[1], made[1]};
}

Lobe flake_lobe_by_tensors(const MipMap& flakes, const FlakePlace& place, const FlakeGloss& gloss, int n) {
  const at::Tensor seen =
      look_up_by_tensors(flakes, place.scale, place.shift_x, place.shift_y, n, Neighbours::none);
  const at::Tensor steepness = gloss.ndf.square(), slopes = seen.narrow(0, 0, 2) * steepness;
  const at::Tensor up = (slopes.square().sum(0) + 1).rsqrt();
  const at::Tensor square_alpha =
      gloss.rough.square().square() + seen[2] * (flake::kSpread * steepness.square());
  const at::Tensor roughness = square_alpha.sqrt().sqrt();
  return {at::stack({slopes[0] * up, slopes[1] * up, up}), gloss.f0, roughness, roughness};
}

}  // namespace patina
