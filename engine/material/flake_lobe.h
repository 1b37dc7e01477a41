#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/surface.h"

namespace patina {

/// The flakes' lobe. A pixel that sees several flakes has their mean slope, and is rougher by their variance:
/// alpha^2 and the slopes' second moments add (Olano, Baker 2010, "LEAN mapping"), of which GGX takes part of
/// the variance only.
/// @param flakes  [3, n, n], slopes along x and y and their variance (flake_map.h)
/// @param ndf     scalar: slopes are multiplied by its square   @param rough  scalar: roughness of one flake
/// @param f0      [3]
/// In float32 one pass over the pixels, and one for the gradient, which has no further derivatives; else as
/// flake_lobe_by_tensors(), the reference.
Lobe flake_lobe(const at::Tensor& flakes, const at::Tensor& ndf, const at::Tensor& rough,
                const at::Tensor& f0);
Lobe flake_lobe_by_tensors(const at::Tensor& flakes, const at::Tensor& ndf, const at::Tensor& rough,
                           const at::Tensor& f0);

}  // namespace patina
