#include "engine/material/glow_kernel.h"

#define PATINA_KERNEL "engine/material/glow_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::glow {

void places(const Quarter& quarter, std::ptrdiff_t row, std::int32_t* ring, float* share) {
  PATINA_ON_TARGET(places(quarter, row, ring, share));
}

void colors(const Quarter& quarter, std::ptrdiff_t row, const float* log2_exitance, float* to) {
  PATINA_ON_TARGET(colors(quarter, row, log2_exitance, to));
}

void add_rows(const ConstPlanes& planes, std::ptrdiff_t row, std::ptrdiff_t opposite, std::ptrdiff_t width,
              float* to) {
  PATINA_ON_TARGET(add_rows(planes, row, opposite, width, to));
}

}  // namespace patina::glow
