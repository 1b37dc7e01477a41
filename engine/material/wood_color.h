#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// Between the colours of earlywood and latewood, as far as a pixel is latewood, raised to a power that
/// varies with the streaks (models.md "wood").
/// @param earlywood, latewood  [3], linear, above 0
/// @param ratio, exponent      [h, w], ratio in [0,1]
/// @return                     [3, h, w]. In float32 one pass over the pixels, and one for the gradient,
/// which
///                             has no further derivatives; else as wood_color_by_tensors(), the reference
at::Tensor wood_color(const at::Tensor& earlywood, const at::Tensor& latewood, const at::Tensor& ratio,
                      const at::Tensor& exponent);
at::Tensor wood_color_by_tensors(const at::Tensor& earlywood, const at::Tensor& latewood,
                                 const at::Tensor& ratio, const at::Tensor& exponent);

}  // namespace patina
