#pragma once

#include "engine/summary/summary.h"
#include "engine/summary/weight_cache.h"

namespace patina {

/// Mean colours of concentric rings around the image's centre, where flash and camera are (paper section 4).
/// The rings have equal radial width, one half of the side in all; the last one also takes the corners.
class RingMeans final : public Summary {
 public:
  explicit RingMeans(int rings);

  /// @return [k, 3 * rings], the rings of red first, from the inside out; display units
  at::Tensor of(const at::Tensor& images) const override;
  std::vector<SummaryBlock> blocks() const override;
  int minimum_resolution() const override { return 2 * rings_; }

 private:
  int rings_;
  WeightCache weights_;  ///< [n * n, rings], each column sums to 1
};

/// Mean colours of upright strips of equal width, as high as the image: the profile of an anisotropic
/// highlight (paper section 4). A pixel that lies in two strips counts for both by its share.
class StripMeans final : public Summary {
 public:
  explicit StripMeans(int strips);

  /// @return [k, 3 * strips], the strips of red first, from left to right; display units
  at::Tensor of(const at::Tensor& images) const override;
  std::vector<SummaryBlock> blocks() const override;
  int minimum_resolution() const override { return 2; }

 private:
  int strips_;
  WeightCache weights_;  ///< [n, strips], each column sums to 1
};

}  // namespace patina
