#pragma once

#include <ATen/core/Tensor.h>

#include "engine/sampling/rng.h"

namespace patina {

/// An image changed at random as a photo, or a fit on its way, differs from a render: in one respect out of
/// blur, tone, tint, crop, contrast, noise, orientation, evenness of light, or by a share of another image.
/// @param image, other  [3, n, n] float32, sRGB in [0,1], n a multiple of 4   @return the same shape and
/// range
at::Tensor vary(const at::Tensor& image, const at::Tensor& other, Rng& rng);

/// Lighter here and darker there, as worn and dyed surfaces are and renders are not.
at::Tensor mottled(const at::Tensor& image, Rng& rng);

/// As cameras do.
at::Tensor sharpened(const at::Tensor& image, Rng& rng);

}  // namespace patina
