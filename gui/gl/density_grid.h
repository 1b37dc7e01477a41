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

/// What of a cloud of points falls into each cell of a plot: what is left to show when points are too many to
/// tell apart.
class DensityGrid {
 public:
  static constexpr int kCellPixels = 2;  ///< side of a cell

  /// An empty grid of cells that cover width x height pixels.
  DensityGrid() = default;
  DensityGrid(const PlotWindow& window, int width, int height);

  /// Counts a point, if it lies in the window (its low edges included, its high edges not).
  /// @param color  as ImU32: red in the lowest byte; its opacity does not matter
  void add(double x, double y, std::uint32_t color = 0);
  void add_dimmed(double x, double y);  ///< likewise, one that is beneath notice

  std::uint64_t total() const { return total_; }  ///< points in the window, dimmed ones included
  std::uint32_t peak() const { return peak_; }    ///< points in the fullest cell, without the dimmed

  /// Rows from the top. Sums over a cell's points, without the dimmed: red, green, blue (0 to 255 each), and
  /// the points themselves.
  const Image& sums() const { return sums_; }
  const Image& dimmed() const { return dimmed_; }  ///< dimmed points, 1 channel

 private:
  std::ptrdiff_t cell_of(double x, double y) const;  ///< -1: outside

  PlotWindow window_;
  double columns_per_x_ = 0, rows_per_y_ = 0;
  Image sums_, dimmed_;
  std::uint64_t total_ = 0;
  std::uint32_t peak_ = 0;
};

}  // namespace patina
