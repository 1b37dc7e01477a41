#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/value_noise.h"

namespace patina {

/// Streaks across the grain (models.md "wood"), which go with the sample, not with the trunk: that is the
/// same to look at, and a move of the sample or a little more of the scale does not exchange all of them.
/// Scalars.
struct Streaks {
  at::Tensor scale, power;        ///< lattice cells per cm; how dark
  at::Tensor centre_x, centre_y;  ///< of the sample, cm
};

/// What the colour of wood is raised to: 1 + power N(scale (place - centre)).
/// @param place             cm, [n + 1, n + 1], with neighbours (look_up.h)
/// @param width_x, width_y  of a pixel, in lattice cells, by which the noise is filtered; scalars above 0
/// @return                  [n, n]. In float32 one pass over the pixels, and one for the gradient, which has
///                          no further derivatives; else as streak_exponent_by_tensors(), the reference
at::Tensor streak_exponent(const WarpedGrid& place, const Streaks& streaks, const ValueNoise& noise,
                           const at::Tensor& width_x, const at::Tensor& width_y);
at::Tensor streak_exponent_by_tensors(const WarpedGrid& place, const Streaks& streaks,
                                      const ValueNoise& noise, const at::Tensor& width_x,
                                      const at::Tensor& width_y);

}  // namespace patina
