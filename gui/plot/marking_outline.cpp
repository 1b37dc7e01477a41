#include "gui/plot/marking_outline.h"

namespace patina {

void MarkingOutline::begin(MarkingTool tool, PlotPlace at) {
  tool_ = tool;
  path_ = {at};
}

void MarkingOutline::extend(PlotPlace to) {
  if (to.x != path_.back().x || to.y != path_.back().y) path_.push_back(to);
}

std::vector<PlotPlace> MarkingOutline::outline() const {
  if (tool_ == MarkingTool::lasso || path_.empty()) return path_;
  const PlotPlace from = path_.front(), to = path_.back();
  return {from, {to.x, from.y}, to, {from.x, to.y}};
}

}  // namespace patina
