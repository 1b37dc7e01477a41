#include "engine/material/wood_kernel.h"

#include <numbers>

#define PATINA_KERNEL "engine/material/wood_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::wood {

void latewood_ratio(const Ring& ring, const float* rings, const float* width, std::ptrdiff_t begin,
                    std::ptrdiff_t end, float* ratio) {
  PATINA_ON_TARGET(latewood_ratio(ring, rings, width, begin, end, ratio));
}

void latewood_ratio_backward(const Ring& ring, const float* rings, const float* width, std::ptrdiff_t begin,
                             std::ptrdiff_t end, const float* gradient, float* by_rings, float* by_width,
                             double* by_ring) {
  PATINA_ON_TARGET(
      latewood_ratio_backward(ring, rings, width, begin, end, gradient, by_rings, by_width, by_ring));
}

void ring_widths(const RingField& field, std::ptrdiff_t begin, std::ptrdiff_t end, float* width) {
  PATINA_ON_TARGET(ring_widths(field, begin, end, width));
}

void ring_widths_backward(const RingField& field, const float* width, const float* gradient,
                          float* by_rings) {
  PATINA_ON_TARGET(ring_widths_backward(field, width, gradient, by_rings));
}

void finish(const Contrast& contrast, const LatewoodField& field, const Grain& grain, std::ptrdiff_t begin,
            std::ptrdiff_t end, const FinishTo& to) {
  PATINA_ON_TARGET(finish(contrast, field, grain, begin, end, to));
}

void finish_backward(const Contrast& contrast, const LatewoodField& field, const ConstPlanes& color,
                     std::ptrdiff_t begin, std::ptrdiff_t end, const FinishGradient& given,
                     const LatewoodGradient& by) {
  PATINA_ON_TARGET(finish_backward(contrast, field, color, begin, end, given, by));
}

}  // namespace patina::wood
