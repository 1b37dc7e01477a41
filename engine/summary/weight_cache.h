#pragma once

#include <ATen/core/Tensor.h>

#include <functional>
#include <map>
#include <mutex>

namespace patina {

/// The weights of a linear map of images, made once for each side and kept. Safe to call from several
/// threads.
class WeightCache {
 public:
  /// @param make  the weights for images of n x n pixels; called without recording gradients
  explicit WeightCache(std::function<at::Tensor(std::int64_t n)> make) : make_(std::move(make)) {}

  at::Tensor of_side(std::int64_t n) const;

 private:
  std::function<at::Tensor(std::int64_t)> make_;
  mutable std::mutex mutex_;
  mutable std::map<std::int64_t, at::Tensor> weights_;
};

}  // namespace patina
