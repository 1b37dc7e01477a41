#pragma once

#include <cstddef>

#include "engine/material/planes.h"

namespace patina {

/// Unit normals of a row of n pixels.
/// @param above  heights of the row above, [n], cm
/// @param here   its own, and one to the right of the last, [n + 1]
void normals_of_row(const float* above, const float* here, float per_pixel, std::ptrdiff_t n,
                    const Planes& normal);

/// The adjoint: adds the gradient by the heights, given that by the normals.
void normals_of_row_backward(const float* above, const float* here, float per_pixel, std::ptrdiff_t n,
                             const ConstPlanes& by_normal, float* by_above, float* by_here);

}  // namespace patina
