#include "gui/explorer_model.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace patina {

ExplorerModel::ExplorerModel(ParameterTable table) : table_(std::move(table)), draws_(table_) {
  const auto axes = plot_axes(table_);
  x_ = axes.front();
  y_ = axes[axes.size() > 1 ? 1 : 0];
}

void ExplorerModel::set_axes(const PlotAxis& x, const PlotAxis& y) {
  x_ = x;
  y_ = y;
}

PlotRange ExplorerModel::default_range(const PlotAxis& axis) const {
  if (draws_.size() > 0) return draws_.extent(axis, draws_.sampling_count() > 0);
  if (axis.kind == PlotAxis::Kind::continuous) {
    const TruncatedNormal& prior = table_.continuous[axis.index].prior;
    return {prior.low, prior.high};
  }
  if (axis.kind == PlotAxis::Kind::discrete) {
    return {-0.5, static_cast<double>(table_.discrete[axis.index].levels.size()) - 0.5};
  }
  return {};
}

std::optional<std::size_t> ExplorerModel::nearest(double x, double y, double pixel_x, double pixel_y,
                                                  double reach) const {
  assert(pixel_x > 0 && pixel_y > 0);
  std::optional<std::size_t> found;
  double least = reach * reach;
  for (std::size_t draw = 0; draw < draws_.size(); ++draw) {
    const double dx = (draws_.place(x_, draw) - x) / pixel_x;
    const double dy = (draws_.place(y_, draw) - y) / pixel_y;
    const double distance = dx * dx + dy * dy;
    // <= for the first, so that a draw exactly at the reach counts; NaN compares false.
    if ((found ? distance < least : distance <= least) && visible(draw)) {
      found = draw;
      least = distance;
    }
  }
  return found;
}

void ExplorerModel::select(std::optional<std::size_t> draw) {
  assert(!draw || *draw < draws_.size());
  selected_ = draw;
}

std::optional<std::size_t> ExplorerModel::best() const {
  std::optional<std::size_t> found;
  for (std::size_t draw = 0; draw < draws_.size(); ++draw) {
    if (std::isnan(draws_.lp(draw)) || !visible(draw)) continue;
    if (!found || draws_.lp(draw) > draws_.lp(*found)) found = draw;
  }
  return found;
}

bool ExplorerModel::select_worse() {
  const double limit = selected_ ? draws_.lp(*selected_) : std::numeric_limits<double>::infinity();
  std::optional<std::size_t> found;
  for (std::size_t draw = 0; draw < draws_.size(); ++draw) {
    const double lp = draws_.lp(draw);
    if (lp < limit && visible(draw) && (!found || lp > draws_.lp(*found))) found = draw;
  }
  if (found) selected_ = found;
  return found.has_value();
}

bool ExplorerModel::select_better() {
  if (!selected_) return select_worse();
  const double limit = draws_.lp(*selected_);
  std::optional<std::size_t> found;
  for (std::size_t draw = 0; draw < draws_.size(); ++draw) {
    const double lp = draws_.lp(draw);
    if (lp > limit && visible(draw) && (!found || lp < draws_.lp(*found))) found = draw;
  }
  if (found) selected_ = found;
  return found.has_value();
}

}  // namespace patina
