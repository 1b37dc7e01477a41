#pragma once

#include <array>
#include <cstddef>

namespace patina {

/// The three planes of an image or of a field of vectors, as loops over pixels take them.
using Planes = std::array<float*, 3>;
using ConstPlanes = std::array<const float*, 3>;

/// From pixel `first` on. @param planes  Planes or ConstPlanes
template <class Pointers>
Pointers from_pixel(Pointers planes, std::ptrdiff_t first) {
  for (auto& plane : planes) plane += first;
  return planes;
}

}  // namespace patina
