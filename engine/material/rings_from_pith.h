#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/value_noise.h"

namespace patina {

/// How a trunk's rings vary in width: noise of `scale` lattice cells per cm lengthens distances from the pith
/// by up to `amplitude` cm; a ring is `size` cm wide. Scalars.
struct RingGrowth {
  at::Tensor scale, amplitude, size;
};

/// Distance from the pith, varying from ring to ring, in rings: (r + amplitude N(scale r)) / size,
/// r = sqrt(x^2 + y^2 + 1e-6 cm^2).
/// @param place     cm from the pith, [h, w]
/// @param noise     of one row
/// @param pixel_cm  how wide a pixel is, by which the noise is filtered
/// @return          [h, w]. In float32 one pass over the pixels, and one for the gradient, which has no
///                  further derivatives; else as rings_from_pith_by_tensors(), the reference
at::Tensor rings_from_pith(const WarpedGrid& place, const RingGrowth& growth, const ValueNoise& noise,
                           double pixel_cm);
at::Tensor rings_from_pith_by_tensors(const WarpedGrid& place, const RingGrowth& growth,
                                      const ValueNoise& noise, double pixel_cm);

}  // namespace patina
