#include "engine/material/heightfield_kernel.h"

#define PATINA_KERNEL "engine/material/heightfield_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina {

void normals_of_row(const float* above, const float* here, float per_pixel, std::ptrdiff_t n,
                    const Planes& normal) {
  PATINA_ON_TARGET(normals_of_row(above, here, per_pixel, n, normal));
}

void normals_of_row_backward(const float* above, const float* here, float per_pixel, std::ptrdiff_t n,
                             const ConstPlanes& by_normal, float* by_above, float* by_here) {
  PATINA_ON_TARGET(normals_of_row_backward(above, here, per_pixel, n, by_normal, by_above, by_here));
}

}  // namespace patina
