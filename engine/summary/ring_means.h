#pragma once

#include <ATen/core/Tensor.h>

#include <map>
#include <mutex>

namespace patina {

/// Mean colours of concentric rings around the image's centre, where flash and camera are. The rings have
/// equal radial width, one half of the side in all; the last one also takes the corners. Safe to call from
/// several threads.
class RingMeans {
 public:
  static constexpr int kRings = 4;

  /// @param image [3, n, n]   @return [3 * kRings], the rings of red first, from the inside out
  at::Tensor operator()(const at::Tensor& image) const;

 private:
  const at::Tensor& weights(std::int64_t n) const;

  mutable std::mutex mutex_;
  mutable std::map<std::int64_t, at::Tensor> weights_;  ///< [n * n, kRings], each column sums to 1
};

}  // namespace patina
