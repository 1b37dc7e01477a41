#pragma once

#include <ATen/core/Tensor.h>

#include <Eigen/Core>
#include <map>
#include <mutex>
#include <vector>

namespace patina {

/// What engine/io/photo.h's resized() does to square images, by weights that it has found out for each size
/// that it has met: many times as fast, the same but for rounding. Safe to call from several threads.
class Resampling {
 public:
  /// @param side  pixels that images are made to have
  explicit Resampling(int side) : side_(side) {}

  /// @param image  [channels, n, n] float32, display values   @return  [channels, side, side], in [0, 1]
  at::Tensor operator()(const at::Tensor& image) const;

 private:
  /// A new pixel of a row is a weighted sum of old ones, from one on.
  struct Taps {
    Eigen::Index first;
    Eigen::VectorXf weights;
  };
  using Filter = std::vector<Taps>;  ///< of each new pixel, along rows and columns alike

  static Filter filter_of(int from, int to);
  const Filter& filter_from(int side) const;

  int side_;
  mutable std::mutex mutex_;
  mutable std::map<int, Filter> filters_;
};

}  // namespace patina
