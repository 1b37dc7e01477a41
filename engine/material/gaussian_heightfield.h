#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/irregularities.h"

namespace patina {

/// A periodic heightfield of independent random phases and Gaussian spectrum (models.md "bump", "metal"):
///   h = Re sum over f of A(f) exp(i phase(f) + 2 pi i f.x) / size^2,
///   A(f) = fscale exp(-(fx / sigma_x)^2 / 2 - (fy / sigma_y)^2 / 2),
/// f on the grid of frequencies, half a step off centre in A: the inverse FFT, its 1/n^2 included, over
/// (pixel size)^2. A finer grid only adds the frequencies that it alone can hold.
/// @param fscale            scalar
/// @param sigma_x, sigma_y  scalars, cycles/cm; the same tensor where they are equal
/// @return                  [n, n], cm
at::Tensor gaussian_heightfield(const Irregularities& z, const at::Tensor& fscale, const at::Tensor& sigma_x,
                                const at::Tensor& sigma_y, double size_cm, int resolution);

}  // namespace patina
