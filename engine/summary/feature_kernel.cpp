#include "engine/summary/feature_kernel.h"

#include <algorithm>
#include <cstring>
#include <vector>

#define PATINA_KERNEL "engine/summary/feature_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::features {

void reflect(const float* x, Shape shape, std::ptrdiff_t border, float* to) {
  PATINA_ON_TARGET(reflect(x, shape, border, to));
}

void reflect_backward(const float* gradient, Shape shape, std::ptrdiff_t border, float* to) {
  PATINA_ON_TARGET(reflect_backward(gradient, shape, border, to));
}

void halve(const float* x, Shape shape, float* to) { PATINA_ON_TARGET(halve(x, shape, to)); }

void halve_backward(const float* gradient, Shape shape, float* to) {
  PATINA_ON_TARGET(halve_backward(gradient, shape, to));
}

void rectify_backward(const float* gradient, const float* y, std::ptrdiff_t size, float* to) {
  PATINA_ON_TARGET(rectify_backward(gradient, y, size, to));
}

void moments(const float* x, std::ptrdiff_t pixels, std::ptrdiff_t channels, float* means, float* products) {
  PATINA_ON_TARGET(moments(x, pixels, channels, means, products));
}

void times(const float* x, std::ptrdiff_t pixels, std::ptrdiff_t channels, const float* matrix,
           const float* row, float* to) {
  PATINA_ON_TARGET(times(x, pixels, channels, matrix, row, to));
}

}  // namespace patina::features
