#include "engine/material/heightfield.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/roll.h>
#include <ATen/ops/stack.h>

#include "engine/material/look_up.h"

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

at::Tensor open_normals(const at::Tensor& height, double pixel_cm) {
  const std::int64_t n = height.size(-1) - 1;
  const at::Tensor here = without_neighbours(height);
  const at::Tensor right = height.narrow(-2, 1, n).narrow(-1, 1, n),
                   above = height.narrow(-2, 0, n).narrow(-1, 0, n);
  return normals(right - here, above - here, pixel_cm);
}

}  // namespace patina
