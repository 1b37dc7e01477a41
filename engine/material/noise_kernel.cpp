#include "engine/material/noise_kernel.h"

#include <cassert>
#include <vector>

#define PATINA_KERNEL "engine/material/noise_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::noise {

void rings(const Rings& rings, std::ptrdiff_t pixels, float* to) {
  PATINA_ON_TARGET(rings(rings, pixels, to));
}

void rings_backward(const Rings& rings, std::ptrdiff_t pixels, const float* gradient,
                    const RingsGradient& by) {
  PATINA_ON_TARGET(rings_backward(rings, pixels, gradient, by));
}

void streaks(const Streaks& streaks, std::ptrdiff_t rows, float* to) {
  PATINA_ON_TARGET(streaks(streaks, rows, to));
}

void streaks_backward(const Streaks& streaks, std::ptrdiff_t rows, const float* gradient,
                      const StreaksGradient& by) {
  PATINA_ON_TARGET(streaks_backward(streaks, rows, gradient, by));
}

void warp(const Warp& warp, std::ptrdiff_t rows, const Two& to) { PATINA_ON_TARGET(warp(warp, rows, to)); }

void warp_backward(const Warp& warp, std::ptrdiff_t rows, const ConstTwo& gradient, const WarpGradient& by) {
  PATINA_ON_TARGET(warp_backward(warp, rows, gradient, by));
}

}  // namespace patina::noise
