#include "engine/summary/weight_cache.h"

#include <ATen/core/grad_mode.h>

namespace patina {

at::Tensor WeightCache::of_side(std::int64_t n) const {
  const std::lock_guard lock(mutex_);
  at::Tensor& cached = weights_[n];
  if (!cached.defined()) {
    const at::NoGradGuard no_grad;
    cached = make_(n);
  }
  return cached;
}

}  // namespace patina
