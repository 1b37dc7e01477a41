#include "engine/material/flake_kernel.h"

#define PATINA_KERNEL "engine/material/flake_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::flake {

void lobe(const Gloss& gloss, const ConstPlanes& flakes, std::ptrdiff_t begin, std::ptrdiff_t end,
          const Planes& normal, float* roughness) {
  PATINA_ON_TARGET(lobe(gloss, flakes, begin, end, normal, roughness));
}

void lobe_backward(const Gloss& gloss, const ConstPlanes& flakes, const Lobe& lobe, const Lobe& gradient,
                   std::ptrdiff_t begin, std::ptrdiff_t end, const Planes& by_flakes, double* by_gloss) {
  PATINA_ON_TARGET(lobe_backward(gloss, flakes, lobe, gradient, begin, end, by_flakes, by_gloss));
}

}  // namespace patina::flake
