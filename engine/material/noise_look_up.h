#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/value_noise.h"

namespace patina {

// Look-ups in float32, in one pass over the pixels each way; first derivatives only. noise_kernel.h has the
// loops.

/// rings_from_pith() (rings_from_pith.h). @param noise  of planes of one row
at::Tensor look_up_rings(const NoiseMixture& noise, const at::Tensor& x, const at::Tensor& y,
                         const at::Tensor& scale, const at::Tensor& amplitude, const at::Tensor& size);

/// streak_exponent() (wood_streaks.h). @param x, y  [n + 1, n + 1]   @return [n, n]
at::Tensor look_up_streaks(const NoiseMixture& noise, const at::Tensor& x, const at::Tensor& y,
                           const at::Tensor& centre_x, const at::Tensor& centre_y, const at::Tensor& scale,
                           const at::Tensor& power);

/// warp_grid() (value_noise.h).
WarpedGrid look_up_warp(const at::Tensor& volume, const at::Tensor& x, const at::Tensor& y,
                        const at::Tensor& z, const at::Tensor& scale, const at::Tensor& amplitude);

}  // namespace patina
