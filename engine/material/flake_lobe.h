#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/look_up.h"
#include "engine/material/surface.h"

namespace patina {

/// Where a map of flakes is looked up (look_up.h). Scalars.
struct FlakePlace {
  at::Tensor scale, shift_x, shift_y;
};

/// How flakes lie and shine.
struct FlakeGloss {
  at::Tensor ndf, rough;  ///< scalars: slopes are multiplied by the square of ndf; roughness of one flake
  at::Tensor f0;          ///< [3]
};

/// The flakes' lobe, of n x n pixels. One that sees several flakes has their mean slope, and is rougher by
/// their variance: alpha^2 and the slopes' second moments add (Olano, Baker 2010, "LEAN mapping"), of which
/// GGX takes part of the variance only.
/// @param flakes  slopes along x and y and their variance (flake_map.h)
/// In float32 one pass over the pixels, and one for the gradient, which has no further derivatives; else as
/// flake_lobe_by_tensors(), the reference.
Lobe flake_lobe(const MipMap& flakes, const FlakePlace& place, const FlakeGloss& gloss, int n);
Lobe flake_lobe_by_tensors(const MipMap& flakes, const FlakePlace& place, const FlakeGloss& gloss, int n);

}  // namespace patina
