#include "engine/chart/draw_chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/chart/panel.h"

namespace patina {
namespace {

constexpr double kNameSize = 12.5, kRadius = 5;
constexpr Colour kFront{170, 174, 178};

/// What a panel shows.
struct Measure {
  Spread ChartPoint::*cost;
  ErrorSpread ChartPoint::*error;
  const char* cost_name;
  const char* error_name;
};

constexpr const char* kSeconds = "seconds per effective draw, search and warm-up included";
constexpr std::array<Measure, 5> kMeasures{
    {{&ChartPoint::seconds_per_draw, &ChartPoint::mean, kSeconds, "worst error of a mean / sd"},
     {&ChartPoint::seconds_per_draw, &ChartPoint::sd, kSeconds, "worst |log ratio of sds|"},
     {&ChartPoint::seconds_per_draw, &ChartPoint::wasserstein, kSeconds, "worst Wasserstein-1 distance / sd"},
     {&ChartPoint::evaluations_per_draw, &ChartPoint::mean,
      "evaluations per effective draw, with and without gradient", "worst error of a mean / sd"},
     {&ChartPoint::seconds_per_draw, &ChartPoint::levels, kSeconds,
      "worst total variation distance of levels"}}};

struct Plotted {
  const ChartPoint& point;
  Spread cost;
  ErrorSpread error;
  Colour colour;
};

std::vector<Plotted> plotted(const std::vector<ChartPoint>& points, const Measure& measure) {
  std::vector<Plotted> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Spread& cost = points[i].*measure.cost;
    const ErrorSpread& error = points[i].*measure.error;
    if (std::isfinite(cost.median) && std::isfinite(error.value.median) && error.value.median > 0)
      result.push_back({points[i], cost, error, series_colour(i)});
  }
  return result;
}

Panel panel_for(const Box& area, const std::vector<Plotted>& points) {
  std::vector<double> costs, errors;
  for (const Plotted& p : points) {
    costs.insert(costs.end(), {p.cost.low, p.cost.high});
    errors.insert(errors.end(), {p.error.value.low, p.error.value.high, p.error.value.median + p.error.bar});
  }
  return {area, fitted_axis(costs, 1.3, 1.5), fitted_axis(errors, 1.8, 1.3)};
}

void draw_front(Scene& scene, const Panel& panel, const std::vector<Plotted>& points) {
  std::vector<CostError> values;
  for (const Plotted& p : points) values.push_back({p.cost.median, p.error.value.median});
  const std::vector<std::size_t> front = pareto_front(values);
  for (std::size_t i = 0; i + 1 < front.size(); ++i) {
    const CostError& from = values[front[i]];
    const CostError& to = values[front[i + 1]];
    scene.shapes.push_back(
        SceneLine{panel.at(from.cost, from.error), panel.at(to.cost, to.error), kFront, 2.5});
  }
}

void draw_point(Scene& scene, const Panel& panel, const Plotted& p) {
  const double x = p.cost.median, y = p.error.value.median, lowest = panel.y.low;
  const Colour pale{p.colour.red, p.colour.green, p.colour.blue, 0.55};
  scene.shapes.push_back(SceneLine{panel.at(p.cost.low, y), panel.at(p.cost.high, y), pale, 1.5});
  scene.shapes.push_back(
      SceneLine{panel.at(x, std::max(p.error.value.low, lowest)), panel.at(x, p.error.value.high), pale, 4});
  scene.shapes.push_back(
      SceneLine{panel.at(x, std::max(y - p.error.bar, lowest)), panel.at(x, y + p.error.bar), p.colour, 1.2});
  if (p.point.is_default)
    scene.shapes.push_back(SceneDisc{panel.at(x, y), kRadius + 4, {0, 0, 0, 0}, kInk, 1.5});
  const Colour fill = p.error.beyond_chance ? p.colour : kWhite;
  scene.shapes.push_back(SceneDisc{panel.at(x, y), kRadius, fill, p.colour, 2});
}

void draw_names(Scene& scene, const Panel& panel, const std::vector<Plotted>& points) {
  constexpr double kOwn = kRadius + 2;
  std::vector<Box> taken;
  for (const Plotted& p : points) {
    const ScenePoint at = panel.at(p.cost.median, p.error.value.median);
    taken.push_back({at.x - kOwn, at.y - kOwn, at.x + kOwn, at.y + kOwn});
    // A bar may be crossed, but not run along.
    const ScenePoint top = panel.at(p.cost.median, p.error.value.high);
    taken.push_back({at.x - 1.5, top.y, at.x + 1.5, at.y});
  }
  LabelPlacer placer(panel.area, taken);
  for (const Plotted& p : points)
    add_name(scene, placer, panel.at(p.cost.median, p.error.value.median), p.point.name, kNameSize, p.colour,
             p.point.is_default);
}

void draw_panel(Scene& scene, const Box& area, const std::vector<ChartPoint>& points,
                const Measure& measure) {
  const std::vector<Plotted> shown = plotted(points, measure);
  const Panel panel = panel_for(area, shown);
  panel.draw_frame(scene, measure.cost_name, measure.error_name);
  draw_front(scene, panel, shown);
  for (const Plotted& p : shown) draw_point(scene, panel, p);
  draw_names(scene, panel, shown);
}

/// Names of settings that have no point, for nothing can be said of their error.
std::string missing(const std::vector<ChartPoint>& points) {
  std::string names;
  for (const ChartPoint& point : points)
    if (!std::isfinite(point.seconds_per_draw.median)) names += (names.empty() ? "" : ", ") + point.name;
  return names.empty() ? "" : "Without draws in its time: " + names + ".";
}

/// How to read it, below the panels.
void draw_key(Scene& scene, const std::vector<ChartPoint>& points) {
  const double bottom = scene.height - 10;
  add_text(
      scene, {24, bottom - 17},
      "Point: median of the repeats, with their range (pale) and the Monte Carlo error (dark). Full: error "
      "beyond chance, hollow: not. Ring: the default. Grey line: Pareto front.",
      Anchor::start, 12, kInk);
  add_text(scene, {24, bottom}, missing(points), Anchor::start, 12, kInk);
}

}  // namespace

Scene draw_chart(const std::vector<ChartPoint>& points, const ChartTitle& title) {
  constexpr double kLeft = 70, kTop = 102, kWidth = 505, kHeight = 245, kGap = 85, kRowGap = 70;
  const bool has_levels = std::ranges::any_of(
      points, [](const ChartPoint& point) { return std::isfinite(point.levels.value.median); });
  const std::size_t panels = has_levels ? kMeasures.size() : kMeasures.size() - 1;
  Scene scene;
  scene.height = has_levels ? 1115 : 800;
  draw_title(scene, title, "Speed against accuracy");
  for (std::size_t i = 0; i < panels; ++i) {
    const double left = kLeft + static_cast<double>(i % 2) * (kWidth + kGap);
    const double top = kTop + static_cast<double>(i / 2) * (kHeight + kRowGap);
    draw_panel(scene, {left, top, left + kWidth, top + kHeight}, points, kMeasures[i]);
  }
  draw_key(scene, points);
  return scene;
}

}  // namespace patina
