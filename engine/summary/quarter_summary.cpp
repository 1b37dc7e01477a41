#include "engine/summary/quarter_summary.h"

#include <cassert>
#include <utility>

namespace patina {

QuarterSummary::QuarterSummary(std::shared_ptr<const Summary> whole, int quarter)
    : whole_(std::move(whole)), quarter_(quarter) {
  assert(quarter >= 0 && quarter < 4);
}

at::Tensor QuarterSummary::of(const at::Tensor& images) const {
  const std::int64_t side = images.size(2) / 2;
  const auto first = [&](bool second_half) { return second_half ? images.size(2) - side : 0; };
  return whole_->of(
      images.narrow(2, first(quarter_ / 2), side).narrow(3, first(quarter_ % 2), side).contiguous());
}

}  // namespace patina
