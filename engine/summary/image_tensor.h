#pragma once

#include <ATen/core/Tensor.h>

#include "engine/image.h"

namespace patina {

/// [3, n, n] float32, of its own memory, from a square RGB image.
at::Tensor to_tensor(const Image& image);

}  // namespace patina
