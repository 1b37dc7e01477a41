#include "engine/material/noise_kernel.h"

#include <cassert>

#define PATINA_KERNEL "engine/material/noise_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::noise {

void rings(const Rings& rings, std::ptrdiff_t begin, std::ptrdiff_t end, float* to) {
  PATINA_ON_TARGET(rings(rings, begin, end, to));
}

void rings_backward(const Rings& rings, std::ptrdiff_t begin, std::ptrdiff_t end, const float* gradient,
                    const RingsGradient& by) {
  PATINA_ON_TARGET(rings_backward(rings, begin, end, gradient, by));
}

void streaks(const Streaks& streaks, std::ptrdiff_t begin, std::ptrdiff_t end, float* to) {
  PATINA_ON_TARGET(streaks(streaks, begin, end, to));
}

void streaks_backward(const Streaks& streaks, std::ptrdiff_t begin, std::ptrdiff_t end, const float* gradient,
                      const StreaksGradient& by) {
  PATINA_ON_TARGET(streaks_backward(streaks, begin, end, gradient, by));
}

void warp(const Warp& warp, std::ptrdiff_t begin, std::ptrdiff_t end, const Two& to) {
  PATINA_ON_TARGET(warp(warp, begin, end, to));
}

void warp_backward(const Warp& warp, std::ptrdiff_t begin, std::ptrdiff_t end, const ConstTwo& gradient,
                   const WarpGradient& by) {
  PATINA_ON_TARGET(warp_backward(warp, begin, end, gradient, by));
}

}  // namespace patina::noise
