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

void wood_color(const Colour& earlywood, const Colour& latewood, const float* ratio, const float* exponent,
                std::ptrdiff_t begin, std::ptrdiff_t end, const Planes& color) {
  PATINA_ON_TARGET(wood_color(earlywood, latewood, ratio, exponent, begin, end, color));
}

void wood_color_backward(const Colour& earlywood, const Colour& latewood, const float* ratio,
                         const float* exponent, std::ptrdiff_t begin, std::ptrdiff_t end,
                         const ConstPlanes& color, const ConstPlanes& gradient, float* by_ratio,
                         float* by_exponent, double* by_earlywood, double* by_latewood) {
  PATINA_ON_TARGET(wood_color_backward(earlywood, latewood, ratio, exponent, begin, end, color, gradient,
                                       by_ratio, by_exponent, by_earlywood, by_latewood));
}

}  // namespace patina::wood
