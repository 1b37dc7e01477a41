#include "engine/material/heightfield_kernel.h"

#define PATINA_KERNEL "engine/material/heightfield_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina {

void normals_of_rows(const float* height, float per_pixel, std::ptrdiff_t n, std::ptrdiff_t begin,
                     std::ptrdiff_t end, const std::array<float*, 3>& normal) {
  PATINA_ON_TARGET(normals_of_rows(height, per_pixel, n, begin, end, normal));
}

void normals_backward(const float* height, float per_pixel, std::ptrdiff_t n,
                      const std::array<const float*, 3>& normal_gradient, float* height_gradient) {
  PATINA_ON_TARGET(normals_backward(height, per_pixel, n, normal_gradient, height_gradient));
}

}  // namespace patina
