#pragma once

#include "engine/summary/summary.h"

namespace patina {

/// A summary of a quarter of the picture alone: 0 top left, 1 top right, 2 bottom left, 3 bottom right; 3 - q
/// lies opposite q.
class QuarterSummary final : public Summary {
 public:
  QuarterSummary(std::shared_ptr<const Summary> whole, int quarter);

  at::Tensor of(const at::Tensor& images) const override;
  std::vector<SummaryBlock> blocks() const override { return whole_->blocks(); }
  int minimum_resolution() const override { return 2 * whole_->minimum_resolution(); }

 private:
  std::shared_ptr<const Summary> whole_;
  int quarter_;
};

}  // namespace patina
