#pragma once

#include <ATen/core/Tensor.h>

#include "engine/image.h"

namespace patina {

/// [3, n, n] float32, of its own memory, from a square RGB image.
at::Tensor to_tensor(const Image& image);

/// An RGB image from [3, height, width] float32.
Image to_image(const at::Tensor& planes);

}  // namespace patina
