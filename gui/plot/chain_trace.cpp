#include "gui/plot/chain_trace.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

void join(ChainTrace::Bucket& bucket, const ChainTrace::Bucket& next) {
  if (next.empty) return;
  if (bucket.empty) {
    bucket = next;
    return;
  }
  bucket.last = next.last;
  bucket.low = std::min(bucket.low, next.low);
  bucket.high = std::max(bucket.high, next.high);
}

/// Makes one bucket of every two.
void halve(std::vector<ChainTrace::Bucket>& buckets) {
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    if (i % 2 == 1) {
      join(buckets[i / 2], buckets[i]);
    } else {
      buckets[i / 2] = buckets[i];
    }
  }
  buckets.resize((buckets.size() + 1) / 2);
}

}  // namespace

void ChainTrace::add(std::int64_t step, double value) {
  if (step < 0 || !std::isfinite(value)) return;
  while (step / steps_per_bucket_ >= static_cast<std::int64_t>(kMostBuckets)) {
    halve(buckets_);
    steps_per_bucket_ *= 2;
  }
  const auto bucket = static_cast<std::size_t>(step / steps_per_bucket_);
  if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
  join(buckets_[bucket], {value, value, value, value, false});
}

}  // namespace patina
