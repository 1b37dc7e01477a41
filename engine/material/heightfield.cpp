#include "engine/material/heightfield.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/remainder.h>
#include <ATen/ops/roll.h>
#include <ATen/ops/stack.h>

namespace patina {

namespace {

at::Tensor normals(const at::Tensor& rise_right, const at::Tensor& rise_up, double pixel_cm) {
  const at::Tensor slope_x = rise_right / pixel_cm, slope_y = rise_up / pixel_cm;
  const at::Tensor z = (slope_x.square() + slope_y.square() + 1).rsqrt();
  return at::stack({-slope_x * z, -slope_y * z, z});
}

}  // namespace

at::Tensor heightfield_normals(const at::Tensor& height, double pixel_cm) {
  // The row above has the larger y.
  return normals(at::roll(height, {-1}, {1}) - height, at::roll(height, {1}, {0}) - height, pixel_cm);
}

at::Tensor without_neighbours(const at::Tensor& planes) {
  const std::int64_t n = planes.size(-1) - 1;
  return planes.narrow(-2, 1, n).narrow(-1, 0, n);
}

at::Tensor open_normals(const at::Tensor& height, double pixel_cm) {
  const std::int64_t n = height.size(-1) - 1;
  const at::Tensor here = without_neighbours(height);
  const at::Tensor right = height.narrow(-2, 1, n).narrow(-1, 1, n),
                   above = height.narrow(-2, 0, n).narrow(-1, 0, n);
  return normals(right - here, above - here, pixel_cm);
}

at::Tensor look_up(const at::Tensor& map, const at::Tensor& scale, const at::Tensor& shift_x,
                   const at::Tensor& shift_y, int resolution) {
  constexpr int kBilinear = 0, kZeros = 0;
  const std::int64_t n = resolution;
  const at::Tensor pixel =
      at::arange(-1, n + 1, scale.options().requires_grad(false)).add(0.5) * (2.0 / n) - 1;
  // [-1,1] is the map without its border.
  const double with_border = static_cast<double>(map.size(2)), share = (with_border - 2) / with_border;
  const auto texture = [&](const at::Tensor& pixels, const at::Tensor& shift) {
    return (at::remainder((pixels + shift) * scale + 1, 2) - 1) * share;
  };
  const at::Tensor x = texture(pixel.narrow(0, 1, n + 1), shift_x).view({1, n + 1}).expand({n + 1, n + 1});
  const at::Tensor y = texture(pixel.narrow(0, 0, n + 1), shift_y).view({n + 1, 1}).expand({n + 1, n + 1});
  return at::grid_sampler_2d(map.to(scale.scalar_type()), at::stack({x, y}, -1).unsqueeze(0), kBilinear,
                             kZeros,
                             /*align_corners=*/false)[0];
}

}  // namespace patina
