#include "engine/posterior/symmetric_kernel.h"

#define PATINA_KERNEL "engine/posterior/symmetric_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::symmetric {

void multiply(const double* matrix, const double* x, double* product, std::ptrdiff_t size) {
  PATINA_ON_TARGET(multiply(matrix, x, product, size));
}

}  // namespace patina::symmetric
