#include "engine/summary/ring_means.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/mm.h>
#include <ATen/ops/zeros.h>

#include <algorithm>
#include <cmath>

namespace patina {

at::Tensor RingMeans::operator()(const at::Tensor& image) const {
  const std::int64_t n = image.size(2);
  return at::mm(image.reshape({3, n * n}), weights(n)).reshape({3 * kRings});
}

const at::Tensor& RingMeans::weights(std::int64_t n) const {
  const std::lock_guard lock(mutex_);
  at::Tensor& cached = weights_[n];
  if (cached.defined()) return cached;
  const at::NoGradGuard no_grad;
  at::Tensor membership = at::zeros({n * n, kRings}, at::kFloat);
  auto entry = membership.accessor<float, 2>();
  for (std::int64_t row = 0; row < n; ++row)
    for (std::int64_t column = 0; column < n; ++column) {
      const double y = (static_cast<double>(row) + 0.5) / static_cast<double>(n) - 0.5;
      const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(n) - 0.5;
      const int ring = std::min(static_cast<int>(std::hypot(x, y) / 0.5 * kRings), kRings - 1);
      entry[row * n + column][ring] = 1;
    }
  cached = membership / membership.sum(0, /*keepdim=*/true).clamp_min(1);
  return cached;
}

}  // namespace patina
