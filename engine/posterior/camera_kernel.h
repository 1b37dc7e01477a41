#pragma once

#include <cstddef>

namespace patina::camera {

/// A sensor's noise on display values (sRGB), in place: white frees so many electrons, noise has the square
/// root of theirs plus `dark_variance` for its sd. @param normals  standard normal deviates, as many   @param
/// count  pixels
void expose(float* pixels, const float* normals, std::ptrdiff_t count, float white, float dark_variance);

}  // namespace patina::camera
