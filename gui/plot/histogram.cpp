#include "gui/plot/histogram.h"

#include <algorithm>
#include <cassert>

namespace patina {

Histogram::Histogram(const PlotRange& range, int bins)
    : range_(range), all_(static_cast<std::size_t>(bins)), marked_(all_.size()) {
  assert(bins > 0 && range.span() > 0);
}

void Histogram::add(double value, bool marked) {
  if (!(value >= range_.low && value < range_.high)) return;
  const double share = (value - range_.low) / range_.span();
  // A value just below the high end may be rounded onto it.
  const std::size_t bin =
      std::min(static_cast<std::size_t>(share * static_cast<double>(all_.size())), all_.size() - 1);
  peak_ = std::max(peak_, ++all_[bin]);
  if (marked) ++marked_[bin];
}

}  // namespace patina
