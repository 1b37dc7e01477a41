#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/capture.h"
#include "engine/material/surface.h"

namespace patina {

/// Radiance of a surface under the capture light, [3, n, n], linear, not clamped (models.md "Capture"):
///   L = light * vignette * c / d^2 * (base_color / pi + sum over lobes of F0 D(c) / (4 c^2))
at::Tensor shade(const Surface& surface, const Capture& capture, int resolution);

/// clamp(radiance, 0, 1) through the display curve, [3, n, n] in [0,1].
at::Tensor display(const at::Tensor& radiance, DisplayCurve curve);

}  // namespace patina
