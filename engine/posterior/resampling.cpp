#include "engine/posterior/resampling.h"

#include <ATen/ops/clamp.h>
#include <ATen/ops/empty.h>

#include <algorithm>
#include <cmath>

#include "engine/io/photo.h"

namespace patina {

Resampling::Filter Resampling::filter_of(int from, int to) {
  // resized() is linear: a grey row with one pixel that is brighter tells that pixel's weights. The filter's
  // negative lobes stay within black and white.
  constexpr float kGrey = 0.5, kBrighter = 0.25, kRounding = 1e-6f;
  Eigen::MatrixXf weights(from, to);
  for (int k = 0; k < from; ++k) {
    Image row(from, 1, 3);
    std::ranges::fill(row.pixels, kGrey);
    for (int c = 0; c < 3; ++c) row.at(0, k, c) += kBrighter;
    const Image response = resized(row, to, 1);
    for (int i = 0; i < to; ++i) weights(k, i) = (response.at(0, i, 0) - kGrey) / kBrighter;
  }
  Filter filter;
  for (int i = 0; i < to; ++i) {
    Eigen::Index first = 0, end = from;
    while (std::abs(weights(first, i)) < kRounding) ++first;
    while (std::abs(weights(end - 1, i)) < kRounding) --end;
    filter.push_back({first, weights.col(i).segment(first, end - first)});
  }
  return filter;
}

const Resampling::Filter& Resampling::filter_from(int side) const {
  const std::lock_guard lock(mutex_);
  const auto found = filters_.find(side);
  return found != filters_.end() ? found->second
                                 : filters_.emplace(side, filter_of(side, side_)).first->second;
}

at::Tensor Resampling::operator()(const at::Tensor& image) const {
  const std::int64_t channels = image.size(0), n = image.size(1);
  if (n == side_) return image;
  using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Filter& filter = filter_from(static_cast<int>(n));
  const at::Tensor dense = image.contiguous(), result = at::empty({channels, side_, side_}, image.options());
  Eigen::RowVectorXf row(n);
  for (std::int64_t c = 0; c < channels; ++c) {
    const Eigen::Map<const RowMajor> from(dense.data_ptr<float>() + c * n * n, n, n);
    Eigen::Map<RowMajor> to(result.data_ptr<float>() + c * side_ * side_, side_, side_);
    for (int i = 0; i < side_; ++i) {
      row.setZero();
      const Taps& down = filter[static_cast<std::size_t>(i)];
      for (Eigen::Index k = 0; k < down.weights.size(); ++k)
        row += down.weights[k] * from.row(down.first + k);
      for (int j = 0; j < side_; ++j) {
        const Taps& across = filter[static_cast<std::size_t>(j)];
        to(i, j) = row.segment(across.first, across.weights.size()).dot(across.weights);
      }
    }
  }
  return result.clamp(0, 1);
}

}  // namespace patina
