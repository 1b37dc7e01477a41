#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// How the latewood ratio q rises and falls over one growth ring, t from 0 to 1 (models.md "wood"):
///   q(t) = clamp(min(t / earlywood_ramp, (latewood_fraction - t) / latewood_ramp + 1), 0, 1).
struct RingProfile {
  at::Tensor earlywood_ramp, latewood_ramp;  ///< scalars, above 0, in rings
  at::Tensor latewood_fraction;              ///< scalar
};

/// q as a pixel sees it that is `width` rings wide: the mean of q(frac r) over r in [rings - width / 2, rings
/// + width / 2], in closed form. frac jumps, and so may q where a ring begins; the mean is continuous, and
/// differentiable in all its arguments. From half a ring on, where pixels can show no rings but only moire,
/// it goes over to the mean of a ring, which it is from one ring on ("clamping"; Norton, Rockwood, Skolmoski
/// 1982).
/// @param rings, width  [h, w], width above 0
/// @return              [h, w] in [0,1]. Of tensor operations, as all here: wood_kernel.h has the loops over
/// pixels
at::Tensor latewood_ratio(const RingProfile& profile, const at::Tensor& rings, const at::Tensor& width);

/// How many rings wide each pixel of a smooth field of rings is: the length of its gradient, by differences
/// with the next row and column. The projection of a square pixel on any direction has this box's variance.
/// @param rings  [h, w], h and w at least 2   @return [h, w], above 0
at::Tensor ring_widths(const at::Tensor& rings);

}  // namespace patina
