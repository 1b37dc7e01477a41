#pragma once

#include <cstdint>
#include <vector>

#include "engine/material/noise_kernel.h"
#include "engine/material/wood_kernel.h"
#include "engine/material/wood_numbers.h"

namespace patina::wood {

/// A cut through a trunk, [n + 1, n + 1] with neighbours (look_up.h), as loops over its pixels read it; the
/// trunk's axis is z. The image's y points down here, as in the paper's code.
class Cut {
 public:
  Cut(Numbers numbers, WoodNoise noise, double size_cm, std::int64_t n);

  std::int64_t side() const { return side_; }  ///< n
  const Numbers& numbers() const { return numbers_; }
  /// Of a row of the grid: where it is in the image, cm.
  double row_place(std::int64_t row) const { return row_places_[static_cast<std::size_t>(row)]; }

  noise::Warp gnarl(std::int64_t first_row) const;
  /// @param x, y  cm from the pith
  noise::Rings growth(const float* x, const float* y) const;
  noise::Streaks streaks(const float* x, const float* y) const;
  Ring ring() const;
  Contrast contrast() const;

 private:
  std::vector<noise::Plane> planes_of(const ValueNoise& noise, const std::vector<Level>& levels,
                                      std::size_t weight) const;

  std::int64_t side_;
  Numbers numbers_;
  WoodNoise noise_;
  std::vector<float> values_;  ///< the numbers'
  std::vector<float> x_, y_, z_;
  std::vector<double> row_places_;
  std::vector<noise::Plane> ring_planes_, streak_planes_;
};

}  // namespace patina::wood
