#pragma once

#include <cstdint>
#include <vector>

#include "engine/image.h"

namespace patina {

/// The part of the plane that a plot shows; y upwards.
struct PlotWindow {
  double x_low = 0, x_high = 1, y_low = 0, y_high = 1;
  bool operator==(const PlotWindow&) const = default;
};

/// How many points fall into each cell of a plot: what is left to show when points are too many to tell
/// apart.
class DensityGrid {
 public:
  static constexpr int kCellPixels = 2;  ///< side of a cell

  /// An empty grid of cells that cover width x height pixels.
  DensityGrid() = default;
  DensityGrid(const PlotWindow& window, int width, int height);

  /// Counts a point, if it lies in the window (its low edges included, its high edges not).
  void add(double x, double y);

  std::uint64_t total() const { return total_; }  ///< points in the window
  std::uint32_t peak() const { return peak_; }    ///< points in the fullest cell

  /// The counts, 1 channel, rows from the top.
  const Image& counts() const { return counts_; }

 private:
  PlotWindow window_;
  double columns_ = 0, rows_ = 0;  ///< cells across; the last ones may lie partly outside
  Image counts_;
  std::uint64_t total_ = 0;
  std::uint32_t peak_ = 0;
};

}  // namespace patina
