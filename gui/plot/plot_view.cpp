#include "gui/plot/plot_view.h"

#include <algorithm>
#include <cmath>

namespace patina {

PlotRange zoomed(const PlotRange& range, double about, double factor) {
  const PlotRange result{about + (range.low - about) * factor, about + (range.high - about) * factor};
  // Closer than this, doubles no longer tell neighbouring pixels apart; wider, spans overflow.
  const double least = 1e-9 * std::max(std::abs(range.low), std::abs(range.high));
  return result.span() > least && result.span() < 1e12 ? result : range;
}

PlotRange moved(const PlotRange& range, double by) { return {range.low + by, range.high + by}; }

}  // namespace patina
