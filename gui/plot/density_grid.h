#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "engine/image.h"

namespace patina {

/// The part of the plane that a plot shows; y upwards.
struct PlotWindow {
  double x_low = 0, x_high = 1, y_low = 0, y_high = 1;
  bool operator==(const PlotWindow&) const = default;
};

/// What lies in the cells of a grid over a plot; rows from the top.
struct DensityCells {
  /// Sums over a cell's points, without the dimmed: red, green, blue (0 to 255 each), and the points
  /// themselves.
  Image sums;
  Image dimmed;            ///< points that are beneath notice, 1 channel
  std::uint32_t peak = 0;  ///< points in the fullest cell, without the dimmed

  DensityCells() = default;
  DensityCells(int columns, int rows) : sums(columns, rows, 4), dimmed(columns, rows, 1) {}

  /// Counts a point. @param color  as ImU32: red in the lowest byte; its opacity does not matter
  void add(std::size_t cell, std::uint32_t color) {
    float* sum = &sums.pixels[4 * cell];
    sum[0] += static_cast<float>(color & 0xff);
    sum[1] += static_cast<float>(color >> 8 & 0xff);
    sum[2] += static_cast<float>(color >> 16 & 0xff);
    sum[3] += 1;
    peak = std::max(peak, static_cast<std::uint32_t>(sum[3]));
  }
  void add_dimmed(std::size_t cell) { dimmed.pixels[cell] += 1; }
};

/// What of a cloud of points falls into each cell of a plot: what is left to show when points are too many to
/// tell apart.
class DensityGrid {
 public:
  static constexpr int kCellPixels = 2;  ///< side of a cell

  /// An empty grid of cells that cover width x height pixels.
  DensityGrid() = default;
  DensityGrid(const PlotWindow& window, int width, int height);

  /// Counts a point, if it lies in the window (its low edges included, its high edges not).
  void add(double x, double y, std::uint32_t color = 0);
  void add_dimmed(double x, double y);  ///< likewise, one that is beneath notice

  std::uint64_t total() const { return total_; }  ///< points in the window, dimmed ones included
  const DensityCells& cells() const { return cells_; }

 private:
  std::ptrdiff_t cell_of(double x, double y) const;  ///< -1: outside

  PlotWindow window_;
  double columns_per_x_ = 0, rows_per_y_ = 0;
  DensityCells cells_;
  std::uint64_t total_ = 0;
};

}  // namespace patina
