#include "gui/plot/plot_cursor.h"

#include <algorithm>
#include <utility>

namespace patina {
namespace {

bool same(const PlotPlace& a, const PlotPlace& b) { return a.x == b.x && a.y == b.y; }

}  // namespace

void PlotCursor::begin(const PlotView& view) {
  active_ = true;
  corners_.clear();
  place_ = {0.5 * (view.x.low + view.x.high), 0.5 * (view.y.low + view.y.high)};
}

void PlotCursor::end() {
  active_ = false;
  corners_.clear();
}

void PlotCursor::move(double right, double up, const PlotView& view) {
  place_ = {std::clamp(place_.x + right * view.x.span(), view.x.low, view.x.high),
            std::clamp(place_.y + up * view.y.span(), view.y.low, view.y.high)};
}

PlotCursor::Step PlotCursor::set_corner(MarkingTool tool) {
  const bool again = !corners_.empty() && same(corners_.back(), place_);
  const bool closes = tool == MarkingTool::box ? !corners_.empty() : again;
  if (!closes) {
    corners_.push_back(place_);
    return Step::opened;
  }
  finished_ = outline(tool);
  const bool points = again && corners_.size() == 1;
  corners_.clear();
  return points ? Step::pointed : Step::closed;
}

std::vector<PlotPlace> PlotCursor::outline(MarkingTool tool) const {
  if (corners_.empty()) return {};
  MarkingOutline outline;
  outline.begin(tool, corners_.front());
  for (const PlotPlace& corner : corners_) outline.extend(corner);
  outline.extend(place_);
  return outline.outline();
}

}  // namespace patina
