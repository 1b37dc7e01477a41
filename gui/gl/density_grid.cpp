#include "gui/gl/density_grid.h"

#include <algorithm>
#include <cassert>

namespace patina {

DensityGrid::DensityGrid(const PlotWindow& window, int width, int height)
    : window_(window),
      columns_(static_cast<double>(width) / kCellPixels),
      rows_(static_cast<double>(height) / kCellPixels),
      counts_((width + kCellPixels - 1) / kCellPixels, (height + kCellPixels - 1) / kCellPixels, 1) {
  assert(width > 0 && height > 0 && window.x_high > window.x_low && window.y_high > window.y_low);
}

void DensityGrid::add(double x, double y) {
  const bool inside = x >= window_.x_low && x < window_.x_high && y >= window_.y_low && y < window_.y_high;
  if (!inside) return;
  const double across = (x - window_.x_low) / (window_.x_high - window_.x_low) * columns_;
  const double down = (window_.y_high - y) / (window_.y_high - window_.y_low) * rows_;
  // A point on the lowest edge, or just below the right one, may be rounded onto the cell after the last.
  const int column = std::min(static_cast<int>(across), counts_.width - 1);
  const int row = std::min(static_cast<int>(down), counts_.height - 1);
  float& count = counts_.at(row, column, 0);
  count += 1;
  ++total_;
  peak_ = std::max(peak_, static_cast<std::uint32_t>(count));
}

}  // namespace patina
