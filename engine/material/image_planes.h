#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>

#include "engine/material/planes.h"

namespace patina {

/// @param image  [3, h, w] float32, contiguous
inline Planes planes_of(const at::Tensor& image) {
  float* first = image.data_ptr<float>();
  const std::int64_t pixels = image.size(1) * image.size(2);
  return {first, first + pixels, first + 2 * pixels};
}

inline ConstPlanes const_planes_of(const at::Tensor& image) {
  const Planes planes = planes_of(image);
  return {planes[0], planes[1], planes[2]};
}

}  // namespace patina
