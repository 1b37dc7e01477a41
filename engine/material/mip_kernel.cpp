#include "engine/material/mip_kernel.h"

#include <algorithm>
#include <array>
#include <cassert>

#define PATINA_KERNEL "engine/material/mip_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::mip {

void look_up(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, float* to) {
  PATINA_ON_TARGET(look_up(problem, begin, end, to));
}

void look_up_backward(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, const float* by_value,
                      Gradient& gradient) {
  PATINA_ON_TARGET(look_up_backward(problem, begin, end, by_value, gradient));
}

}  // namespace patina::mip
