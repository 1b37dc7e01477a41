#include "engine/material/spectrum_kernel.h"

#define PATINA_KERNEL "engine/material/spectrum_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::spectrum {

void amplitudes(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, float* to) {
  PATINA_ON_TARGET(amplitudes(problem, begin, end, to));
}

void amplitudes_backward(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                         const float* by_amplitudes, const Gradient& gradient) {
  PATINA_ON_TARGET(amplitudes_backward(problem, begin, end, by_amplitudes, gradient));
}

}  // namespace patina::spectrum
