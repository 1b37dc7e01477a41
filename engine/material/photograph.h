#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/capture.h"
#include "engine/material/surface.h"

namespace patina {

/// display(shade(surface, capture, resolution), curve) of shading.h, [3, n, n] in [0,1]. In float32 it takes
/// one pass over the pixels, and one more for its gradient, which has no further derivatives.
at::Tensor photograph(const Surface& surface, const Capture& capture, int resolution, DisplayCurve curve);

}  // namespace patina
