#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// Unit normals of a heightfield by one-sided differences, normalize(-dh/dx, -dh/dy, 1), x to the right, y up
/// (rows go down). This one wraps around: for a heightfield with the period of the image.
/// @param height [n, n], cm   @param pixel_cm  side of a pixel, cm   @return [3, n, n]
at::Tensor heightfield_normals(const at::Tensor& height, double pixel_cm);

/// The same for a heightfield that goes on beyond the image: wrapping around would cut a seam along two
/// borders.
/// @param height [n + 1, n + 1] with neighbours, as look_up() (look_up.h) returns it   @return [3, n, n]
at::Tensor open_normals(const at::Tensor& height, double pixel_cm);

/// The same out of tensor operations, in any precision: what these two are for doubles, and what their
/// float32 kernel is tested against.
at::Tensor heightfield_normals_by_tensors(const at::Tensor& height, double pixel_cm);
at::Tensor open_normals_by_tensors(const at::Tensor& height, double pixel_cm);

}  // namespace patina
