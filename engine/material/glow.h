#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/capture.h"

namespace patina {

/// Distances from the beam at which a glow has to be known to be known at each of n x n pixels. The beam is
/// not thin: a pixel at r from the middle is sqrt(r^2 + radius^2) from it.
/// @return [k], cm, denser towards the beam
at::Tensor glow_rings(const Capture& capture, int n, const at::TensorOptions& options);

/// The apparent colour of a surface that glows around its middle: what a diffuse surface would need to send
/// as much light to the camera, had the flash lit all of it.
/// @param log2_exitance  [k], of light that leaves the surface at glow_rings() per area, 1/cm^2; between them
///     it is interpolated   @return [3, n, n], its planes alike
at::Tensor glow_color(const at::Tensor& log2_exitance, const Capture& capture, int n);
/// The same by tensor operations, for tests and for what is not float32.
at::Tensor glow_color_by_tensors(const at::Tensor& log2_exitance, const Capture& capture, int n);

}  // namespace patina
