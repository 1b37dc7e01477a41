#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// Unit normals of a periodic heightfield by one-sided differences with wrap-around: normalize(-dh/dx,
/// -dh/dy, 1), x to the right, y up (rows go down).
/// @param height [n, n], cm   @param pixel_cm  side of a pixel, cm   @return [3, n, n]
at::Tensor heightfield_normals(const at::Tensor& height, double pixel_cm);

/// Looks a periodic map up bilinearly at ((pixel coordinate in [-1,1]) + shift) * scale, so that scale < 1
/// magnifies (models.md "Capture"). Differentiable in scale and shift.
/// @param map     [1, c, m + 2, m + 2] with its border (irregularities.h)
/// @param scale, shift_x, shift_y  scalars
/// @return    [c, n, n]
at::Tensor look_up(const at::Tensor& map, const at::Tensor& scale, const at::Tensor& shift_x,
                   const at::Tensor& shift_y, int resolution);

}  // namespace patina
