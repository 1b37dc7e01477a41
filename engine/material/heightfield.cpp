#include "engine/material/heightfield.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/remainder.h>
#include <ATen/ops/roll.h>
#include <ATen/ops/stack.h>

namespace patina {

at::Tensor heightfield_normals(const at::Tensor& height, double pixel_cm) {
  const at::Tensor slope_x = (at::roll(height, {-1}, {1}) - height) / pixel_cm;
  const at::Tensor slope_y =
      (at::roll(height, {1}, {0}) - height) / pixel_cm;  // the row above has the larger y
  const at::Tensor z = (slope_x.square() + slope_y.square() + 1).rsqrt();
  return at::stack({-slope_x * z, -slope_y * z, z});
}

at::Tensor look_up(const at::Tensor& map, const at::Tensor& scale, const at::Tensor& shift_x,
                   const at::Tensor& shift_y, int resolution) {
  constexpr int kBilinear = 0, kZeros = 0;
  const std::int64_t n = resolution;
  const at::Tensor pixel = (at::arange(n, scale.options().requires_grad(false)) + 0.5) * (2.0 / n) - 1;
  // [-1,1] is the map without its border.
  const double with_border = static_cast<double>(map.size(2)), share = (with_border - 2) / with_border;
  const auto texture = [&](const at::Tensor& shift) {
    return (at::remainder((pixel + shift) * scale + 1, 2) - 1) * share;
  };
  const at::Tensor x = texture(shift_x).view({1, n}).expand({n, n});
  const at::Tensor y = texture(shift_y).view({n, 1}).expand({n, n});
  return at::grid_sampler_2d(map.to(scale.scalar_type()), at::stack({x, y}, -1).unsqueeze(0), kBilinear,
                             kZeros,
                             /*align_corners=*/false)[0];
}

}  // namespace patina
