#include "engine/material/wood_kernel.h"

#include <numbers>

#define PATINA_KERNEL "engine/material/wood_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::wood {

void ring_widths(const RingField& field, std::ptrdiff_t rows, float* width) {
  PATINA_ON_TARGET(ring_widths(field, rows, width));
}

void ring_widths_backward(const RingField& field, std::ptrdiff_t rows, const float* width,
                          const float* gradient, float* by_rings) {
  PATINA_ON_TARGET(ring_widths_backward(field, rows, width, gradient, by_rings));
}

void finish(const Ring& ring, const Contrast& contrast, const Rows& rows, const Grain& grain,
            const MapsTo& to) {
  PATINA_ON_TARGET(finish(ring, contrast, rows, grain, to));
}

void finish_backward(const Ring& ring, const Contrast& contrast, const Rows& rows, const ConstPlanes& color,
                     const MapsGradient& given, const RowsGradient& by) {
  PATINA_ON_TARGET(finish_backward(ring, contrast, rows, color, given, by));
}

}  // namespace patina::wood
