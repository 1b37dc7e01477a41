#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// Unit normals of a heightfield by one-sided differences, normalize(-dh/dx, -dh/dy, 1), x to the right, y up
/// (rows go down). This one wraps around: for a heightfield with the period of the image.
/// @param height [n, n], cm   @param pixel_cm  side of a pixel, cm   @return [3, n, n]
at::Tensor heightfield_normals(const at::Tensor& height, double pixel_cm);

/// The same for a heightfield that goes on beyond the image: wrapping around would cut a seam along two
/// borders.
/// @param height [n + 1, n + 1] with neighbours, as look_up() returns it   @return [3, n, n]
at::Tensor open_normals(const at::Tensor& height, double pixel_cm);

/// Looks a periodic map up bilinearly at ((pixel coordinate in [-1,1]) + shift) * scale, so that scale < 1
/// magnifies (models.md "Capture"). Differentiable in scale and shift.
/// @param map     [1, c, m + 2, m + 2] with its border (irregularities.h)
/// @param scale, shift_x, shift_y  scalars
/// @return    [c, n + 1, n + 1]: the image with its neighbours, the row above it and the column to its right
at::Tensor look_up(const at::Tensor& map, const at::Tensor& scale, const at::Tensor& shift_x,
                   const at::Tensor& shift_y, int resolution);

/// The image itself of planes with neighbours. @param planes [..., n + 1, n + 1]   @return [..., n, n]
at::Tensor without_neighbours(const at::Tensor& planes);

}  // namespace patina
