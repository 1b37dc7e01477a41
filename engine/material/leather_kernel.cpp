#include "engine/material/leather_kernel.h"

#include <array>
#include <numbers>

#define PATINA_KERNEL "engine/material/leather_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::leather {

void finish(const Relief& relief, const Maps& maps, std::ptrdiff_t begin, std::ptrdiff_t end, float* height,
            float* roughness) {
  PATINA_ON_TARGET(finish(relief, maps, begin, end, height, roughness));
}

void finish_backward(const Relief& relief, const Maps& maps, std::ptrdiff_t begin, std::ptrdiff_t end,
                     const float* by_height, const float* by_roughness, const FinishGradient& by) {
  PATINA_ON_TARGET(finish_backward(relief, maps, begin, end, by_height, by_roughness, by));
}

}  // namespace patina::leather
