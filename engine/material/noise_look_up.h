#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <vector>

#include "engine/material/value_noise.h"

namespace patina {

/// One level of value noise among those that are mixed: runs of 2^x_level by 2^y_level values.
struct NoisePlane {
  at::Tensor values;  ///< ValueNoise::levels[y_level][x_level]
  std::int64_t x_level, y_level;
};

// Look-ups in float32, in one pass over the pixels each way; first derivatives only. noise_kernel.h has the
// loops.

/// The sum of planes, at most four, by their weights.
/// @param x, y     [h, w], lattice coordinates   @param weights  [planes]   @return [h, w]
at::Tensor look_up_planes(const std::vector<NoisePlane>& planes, const at::Tensor& x, const at::Tensor& y,
                          const at::Tensor& weights);

/// warp_grid() (value_noise.h).
WarpedGrid look_up_warp(const at::Tensor& volume, const at::Tensor& x, const at::Tensor& y,
                        const at::Tensor& z, const at::Tensor& scale, const at::Tensor& amplitude);

}  // namespace patina
