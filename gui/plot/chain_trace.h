#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace patina {

/// The course of a chain, small enough to draw however long it is: its steps in buckets of 1, 2, 4 ... steps,
/// and of each the values it came in with, left with, and went between. What lies between stays in view.
class ChainTrace {
 public:
  static constexpr std::size_t kMostBuckets = 512;

  struct Bucket {
    double first = 0, last = 0, low = 0, high = 0;
    bool empty = true;
  };

  /// Steps come in rising order; values that are not finite are left out.
  void add(std::int64_t step, double value);

  std::int64_t steps_per_bucket() const { return steps_per_bucket_; }
  const std::vector<Bucket>& buckets() const { return buckets_; }  ///< from step 0 on

 private:
  std::vector<Bucket> buckets_;
  std::int64_t steps_per_bucket_ = 1;
};

}  // namespace patina
