#include "engine/summary/bin_means.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/mm.h>
#include <ATen/ops/zeros.h>

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

at::Tensor ring_weights(std::int64_t n, int rings) {
  at::Tensor membership = at::zeros({n * n, rings}, at::kFloat);
  auto entry = membership.accessor<float, 2>();
  for (std::int64_t row = 0; row < n; ++row)
    for (std::int64_t column = 0; column < n; ++column) {
      const double y = (static_cast<double>(row) + 0.5) / static_cast<double>(n) - 0.5;
      const double x = (static_cast<double>(column) + 0.5) / static_cast<double>(n) - 0.5;
      const int ring = std::min(static_cast<int>(std::hypot(x, y) / 0.5 * rings), rings - 1);
      entry[row * n + column][ring] = 1;
    }
  return membership / membership.sum(0, /*keepdim=*/true).clamp_min(1);
}

at::Tensor strip_weights(std::int64_t n, int strips) {
  at::Tensor overlap = at::zeros({n, strips}, at::kFloat);
  auto entry = overlap.accessor<float, 2>();
  for (std::int64_t column = 0; column < n; ++column)
    for (int strip = 0; strip < strips; ++strip) {
      // In units of 1 / (n strips) of the side: pixels and strips both begin and end at whole numbers.
      const std::int64_t begin = std::max(column * strips, strip * n);
      const std::int64_t end = std::min((column + 1) * strips, (strip + 1) * n);
      entry[column][strip] =
          static_cast<float>(std::max<std::int64_t>(end - begin, 0)) / static_cast<float>(n);
    }
  return overlap;
}

}  // namespace

RingMeans::RingMeans(int rings)
    : rings_(rings), weights_([rings](std::int64_t n) { return ring_weights(n, rings); }) {}

at::Tensor RingMeans::of(const at::Tensor& images) const {
  const std::int64_t n = images.size(3);
  return at::mm(images.reshape({-1, n * n}), weights_.of_side(n)).reshape({-1, 3 * rings_});
}

std::vector<SummaryBlock> RingMeans::blocks() const {
  return {{std::to_string(rings_) + " ring means", 3 * rings_, ErrorScale::regional}};
}

StripMeans::StripMeans(int strips)
    : strips_(strips), weights_([strips](std::int64_t n) { return strip_weights(n, strips); }) {}

at::Tensor StripMeans::of(const at::Tensor& images) const {
  const std::int64_t n = images.size(3);
  return at::mm(images.mean(2).reshape({-1, n}), weights_.of_side(n)).reshape({-1, 3 * strips_});
}

std::vector<SummaryBlock> StripMeans::blocks() const {
  return {{std::to_string(strips_) + " strip means", 3 * strips_, ErrorScale::regional}};
}

}  // namespace patina
