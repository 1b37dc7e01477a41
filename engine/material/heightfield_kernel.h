#pragma once

#include <array>
#include <cstddef>

namespace patina {

/// Unit normals of rows begin ... end - 1 of an n x n image. @param height  [n + 1, n + 1] with neighbours,
/// cm
void normals_of_rows(const float* height, float per_pixel, std::ptrdiff_t n, std::ptrdiff_t begin,
                     std::ptrdiff_t end, const std::array<float*, 3>& normal);

/// The adjoint: adds the gradient by the heights, given that by the normals, to height_gradient. For all
/// rows, which share heights.
void normals_backward(const float* height, float per_pixel, std::ptrdiff_t n,
                      const std::array<const float*, 3>& normal_gradient, float* height_gradient);

}  // namespace patina
