#include "engine/posterior/camera_kernel.h"

#define PATINA_KERNEL "engine/posterior/camera_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::camera {

void expose(float* pixels, const float* normals, std::ptrdiff_t count, float white, float dark_variance) {
  PATINA_ON_TARGET(expose(pixels, normals, count, white, dark_variance));
}

}  // namespace patina::camera
