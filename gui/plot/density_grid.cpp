#include "gui/plot/density_grid.h"

#include <algorithm>
#include <cassert>

namespace patina {

DensityGrid::DensityGrid(const PlotWindow& window, int width, int height)
    : window_(window),
      columns_per_x_(width / (kCellPixels * (window.x_high - window.x_low))),
      rows_per_y_(height / (kCellPixels * (window.y_high - window.y_low))),
      cells_((width + kCellPixels - 1) / kCellPixels, (height + kCellPixels - 1) / kCellPixels) {
  assert(width > 0 && height > 0 && window.x_high > window.x_low && window.y_high > window.y_low);
}

std::ptrdiff_t DensityGrid::cell_of(double x, double y) const {
  const bool inside = x >= window_.x_low && x < window_.x_high && y >= window_.y_low && y < window_.y_high;
  if (!inside) return -1;
  // A point on the lowest edge, or just below the right one, may be rounded onto the cell after the last.
  const int column =
      std::min(static_cast<int>((x - window_.x_low) * columns_per_x_), cells_.dimmed.width - 1);
  const int row = std::min(static_cast<int>((window_.y_high - y) * rows_per_y_), cells_.dimmed.height - 1);
  return static_cast<std::ptrdiff_t>(row) * cells_.dimmed.width + column;
}

void DensityGrid::add(double x, double y, std::uint32_t color) {
  const std::ptrdiff_t cell = cell_of(x, y);
  if (cell < 0) return;
  cells_.add(static_cast<std::size_t>(cell), color);
  ++total_;
}

void DensityGrid::add_dimmed(double x, double y) {
  const std::ptrdiff_t cell = cell_of(x, y);
  if (cell < 0) return;
  cells_.add_dimmed(static_cast<std::size_t>(cell));
  ++total_;
}

}  // namespace patina
