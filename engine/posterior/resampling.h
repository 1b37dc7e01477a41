#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// What engine/io/photo.h's resized() does to a square image's rows, as a matrix [to, from]; it is linear and
/// the same along rows and columns, but for the clamping at black and white.
at::Tensor resampling_matrix(int from, int to);

}  // namespace patina
