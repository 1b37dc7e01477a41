#include "gui/explorer_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace patina {
namespace {

constexpr std::size_t kUsualRangeDraws = 4096;
constexpr double kUnusual = 0.02;  // at either end

/// Whether a place lies inside an outline: a ray to the right of it crosses an odd number of lines.
bool is_inside(PlotPlace at, std::span<const PlotPlace> outline) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const PlotPlace a = outline[i], b = outline[(i + 1) % outline.size()];
    if ((a.y > at.y) == (b.y > at.y)) continue;
    if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

}  // namespace

ExplorerModel::ExplorerModel(ParameterTable table) : table_(std::move(table)), draws_(table_) {
  const auto axes = plot_axes(table_);
  choices_.x = axes.front();
  choices_.y = axes[axes.size() > 1 ? 1 : 0];
}

void ExplorerModel::append(std::span<const Draw> draws) {
  const std::size_t before = draws_.size();
  draws_.append(draws);
  find_starred(before);
  if (!awaited_) return;
  if (const auto found = draws_.find(*awaited_, before)) select(found);
}

void ExplorerModel::restore(const ExplorerChoices& choices) {
  choices_ = choices;
  awaited_.reset();
  find_starred(0);
}

void ExplorerModel::take_over(const ExplorerModel& earlier) {
  ExplorerChoices choices = earlier.choices_;
  const std::optional<std::size_t> selected = std::exchange(choices.selected, std::nullopt);
  choices.marked = {};
  restore(choices);
  awaited_ = selected ? earlier.draws_.where(*selected) : earlier.awaited_;
}

void ExplorerModel::set_axes(const PlotAxis& x, const PlotAxis& y) {
  if (x == choices_.x && y == choices_.y) return;
  choices_.x = x;
  choices_.y = y;
  show_all(x, y);
}

std::optional<PlotPart> ExplorerModel::part(const PlotAxis& x, const PlotAxis& y) const {
  const auto found =
      std::ranges::find_if(choices_.parts, [&](const PlotPart& part) { return part.x == x && part.y == y; });
  return found == choices_.parts.end() ? std::nullopt : std::optional(*found);
}

void ExplorerModel::show_part(const PlotPart& part) {
  show_all(part.x, part.y);
  choices_.parts.push_back(part);
}

void ExplorerModel::show_all(const PlotAxis& x, const PlotAxis& y) {
  std::erase_if(choices_.parts, [&](const PlotPart& part) { return part.x == x && part.y == y; });
}

PlotRange ExplorerModel::default_range(const PlotAxis& axis) const {
  if (draws_.size() > 0) {
    const bool steps = axis.kind == PlotAxis::Kind::iteration;  // warm-up's are worth seeing, if shown
    return draws_.extent(axis, steps ? hides_warmup() : draws_.sampling_count() > 0);
  }
  if (axis.kind == PlotAxis::Kind::continuous) {
    const TruncatedNormal& prior = table_.continuous[axis.index].prior;
    return {prior.low, prior.high};
  }
  if (axis.kind == PlotAxis::Kind::discrete) {
    return {-0.5, static_cast<double>(table_.discrete[axis.index].levels.size()) - 0.5};
  }
  return {};
}

PlotRange ExplorerModel::usual_range(const PlotAxis& axis) const {
  const std::size_t stride = draws_.size() / kUsualRangeDraws + 1;
  std::vector<double> places;
  for (std::size_t draw = 0; draw < draws_.size(); draw += stride) {
    const double place = draws_.place(axis, draw);
    if (in_answer(draw) && std::isfinite(place)) places.push_back(place);
  }
  if (places.empty()) return default_range(axis);
  const auto quantile = [&](double share) {
    const auto at = places.begin() + std::lround(share * static_cast<double>(places.size() - 1));
    std::nth_element(places.begin(), at, places.end());
    return *at;
  };
  return {quantile(kUnusual), quantile(1 - kUnusual)};
}

std::optional<std::size_t> ExplorerModel::nearest(const PlotAxis& x, const PlotAxis& y, PlotPlace at,
                                                  PlotPlace pixel, double reach) const {
  assert(pixel.x > 0 && pixel.y > 0);
  std::optional<std::size_t> found;
  double least = reach * reach;
  const double across = 1 / pixel.x, up = 1 / pixel.y;
  std::array<double, 2048> xs{}, ys{};
  for (std::size_t first = 0; first < draws_.size(); first += xs.size()) {
    const std::size_t count = std::min(xs.size(), draws_.size() - first);
    draws_.places(x, first, std::span(xs).first(count));
    draws_.places(y, first, std::span(ys).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const double dx = (xs[i] - at.x) * across, dy = (ys[i] - at.y) * up;
      const double distance = dx * dx + dy * dy;
      // <= for the first, so that a draw exactly at the reach counts; NaN compares false.
      if ((found ? distance < least : distance <= least) && visible(first + i)) {
        found = first + i;
        least = distance;
      }
    }
  }
  return found;
}

void ExplorerModel::select(std::optional<std::size_t> draw) {
  assert(!draw || *draw < draws_.size());
  choices_.selected = draw;
  awaited_.reset();
}

void ExplorerModel::await(const DrawPlace& place) { awaited_ = place; }

std::optional<std::size_t> ExplorerModel::best() const { return draws_.best(hides_warmup()); }

bool ExplorerModel::select_worse() {
  const double limit =
      choices_.selected ? draws_.lp(*choices_.selected) : std::numeric_limits<double>::infinity();
  std::optional<std::size_t> found;
  for (std::size_t draw = 0; draw < draws_.size(); ++draw) {
    const double lp = draws_.lp(draw);
    if (lp < limit && visible(draw) && (!found || lp > draws_.lp(*found))) found = draw;
  }
  if (found) choices_.selected = found;
  return found.has_value();
}

bool ExplorerModel::select_better() {
  if (!choices_.selected) return select_worse();
  const double limit = draws_.lp(*choices_.selected);
  std::optional<std::size_t> found;
  for (std::size_t draw = 0; draw < draws_.size(); ++draw) {
    const double lp = draws_.lp(draw);
    if (lp > limit && visible(draw) && (!found || lp < draws_.lp(*found))) found = draw;
  }
  if (found) choices_.selected = found;
  return found.has_value();
}

void ExplorerModel::mark(const DrawSet& draws, Marking how) {
  DrawSet& marked = choices_.marked;
  marked = how == Marking::add ? marked.with(draws) : how == Marking::remove ? marked.without(draws) : draws;
}

DrawSet ExplorerModel::inside(const PlotAxis& x, const PlotAxis& y,
                              std::span<const PlotPlace> outline) const {
  if (outline.size() < 3) return {};
  const auto [left, right] = std::ranges::minmax(outline, {}, &PlotPlace::x);
  const auto [lowest, highest] = std::ranges::minmax(outline, {}, &PlotPlace::y);
  return DrawSet::of(draws_.size(),
                     [&, low = left.x, high = right.x, bottom = lowest.y, top = highest.y](std::size_t draw) {
                       const PlotPlace at{draws_.place(x, draw), draws_.place(y, draw)};
                       const bool near = at.x >= low && at.x <= high && at.y >= bottom && at.y <= top;
                       return near && visible(draw) && is_inside(at, outline);
                     });
}

void ExplorerModel::set_stars(std::vector<Star> stars) {
  choices_.stars = std::move(stars);
  find_starred(0);
}

void ExplorerModel::find_starred(std::size_t from) {
  const bool all_known =
      std::ranges::all_of(stars(), [&](const Star& star) { return draw_of(star).has_value(); });
  if (all_known) return;
  for (std::size_t draw = from; draw < draws_.size(); ++draw) {
    if (starred(draw)) starred_draws_[{draws_.chain(draw), draws_.iteration(draw)}] = draw;
  }
}

bool ExplorerModel::starred(std::size_t draw) const {
  return std::ranges::any_of(stars(), [&](const Star& star) {
    return star.chain == draws_.chain(draw) && star.iteration == draws_.iteration(draw);
  });
}

void ExplorerModel::star(std::size_t draw, bool on) {
  if (starred(draw) == on) return;
  const DrawPlace place = draws_.where(draw);
  starred_draws_[place] = draw;
  if (on) {
    choices_.stars.push_back({place.chain, place.iteration, {}});
  } else {
    std::erase_if(choices_.stars, [&](const Star& star) {
      return DrawPlace{star.chain, star.iteration} == place;
    });
  }
}

void ExplorerModel::annotate(std::size_t star, const std::string& note) {
  choices_.stars.at(star).note = note;
}

std::optional<std::size_t> ExplorerModel::draw_of(const Star& star) const {
  const auto found = starred_draws_.find({star.chain, star.iteration});
  if (found == starred_draws_.end()) return std::nullopt;
  return found->second;
}

PlotRange range_of(const DrawColumns& draws, const DrawSet& set, const PlotAxis& axis) {
  PlotRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t draw = 0; draw < draws.size(); ++draw) {
    if (!set.contains(draw)) continue;
    const double place = draws.place(axis, draw);
    range = {std::min(range.low, place), std::max(range.high, place)};
  }
  return range.low <= range.high ? range : PlotRange{0, 0};
}

}  // namespace patina
