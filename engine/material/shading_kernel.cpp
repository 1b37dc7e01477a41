#include "engine/material/shading_kernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>

#define PATINA_KERNEL "engine/material/shading_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina {

void shade_pixels(const ShadingProblem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                  const Planes& image) {
  PATINA_ON_TARGET(shade_pixels(problem, begin, end, image));
}

void shade_pixels_backward(const ShadingProblem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                           const ConstPlanes& image, const ConstPlanes& image_gradient,
                           ShadingGradient& gradient) {
  PATINA_ON_TARGET(shade_pixels_backward(problem, begin, end, image, image_gradient, gradient));
}

}  // namespace patina
