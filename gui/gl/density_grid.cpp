#include "gui/gl/density_grid.h"

#include <algorithm>
#include <cassert>

namespace patina {

DensityGrid::DensityGrid(const PlotWindow& window, int width, int height)
    : window_(window),
      columns_per_x_(width / (kCellPixels * (window.x_high - window.x_low))),
      rows_per_y_(height / (kCellPixels * (window.y_high - window.y_low))),
      sums_((width + kCellPixels - 1) / kCellPixels, (height + kCellPixels - 1) / kCellPixels, 4),
      dimmed_(sums_.width, sums_.height, 1) {
  assert(width > 0 && height > 0 && window.x_high > window.x_low && window.y_high > window.y_low);
}

std::ptrdiff_t DensityGrid::cell_of(double x, double y) const {
  const bool inside = x >= window_.x_low && x < window_.x_high && y >= window_.y_low && y < window_.y_high;
  if (!inside) return -1;
  // A point on the lowest edge, or just below the right one, may be rounded onto the cell after the last.
  const int column = std::min(static_cast<int>((x - window_.x_low) * columns_per_x_), sums_.width - 1);
  const int row = std::min(static_cast<int>((window_.y_high - y) * rows_per_y_), sums_.height - 1);
  return static_cast<std::ptrdiff_t>(row) * sums_.width + column;
}

void DensityGrid::add(double x, double y, std::uint32_t color) {
  const std::ptrdiff_t cell = cell_of(x, y);
  if (cell < 0) return;
  float* sums = &sums_.pixels[static_cast<std::size_t>(4 * cell)];
  sums[0] += static_cast<float>(color & 0xff);
  sums[1] += static_cast<float>(color >> 8 & 0xff);
  sums[2] += static_cast<float>(color >> 16 & 0xff);
  sums[3] += 1;
  ++total_;
  peak_ = std::max(peak_, static_cast<std::uint32_t>(sums[3]));
}

void DensityGrid::add_dimmed(double x, double y) {
  const std::ptrdiff_t cell = cell_of(x, y);
  if (cell < 0) return;
  dimmed_.pixels[static_cast<std::size_t>(cell)] += 1;
  ++total_;
}

}  // namespace patina
