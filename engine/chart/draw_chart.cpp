#include "engine/chart/draw_chart.h"

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
constexpr std::array<Measure, 4> kMeasures{
    {{&ChartPoint::seconds_per_draw, &ChartPoint::mean, kSeconds, "worst error of a mean / sd"},
     {&ChartPoint::seconds_per_draw, &ChartPoint::sd, kSeconds, "worst |log ratio of sds|"},
     {&ChartPoint::seconds_per_draw, &ChartPoint::wasserstein, kSeconds, "worst Wasserstein-1 distance / sd"},
     {&ChartPoint::evaluations_per_draw, &ChartPoint::mean, "gradient evaluations per effective draw",
      "worst error of a mean / sd"}}};

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

void draw_title(Scene& scene, const ChartTitle& title, const std::string& what) {
  scene.title = what + ": " + title.target;
  add_text(scene, {24, 28}, what + ": " + title.target, Anchor::start, 17, kInk, true);
  add_text(scene, {24, 48}, title.gold, Anchor::start, 12.5, kInk);
  add_text(scene, {24, 65}, title.how, Anchor::start, 12.5, kPale);
}

}  // namespace

Scene draw_chart(const std::vector<ChartPoint>& points, const ChartTitle& title) {
  constexpr double kLeft = 70, kTop = 102, kWidth = 505, kHeight = 245, kGap = 85, kRowGap = 70;
  Scene scene;
  draw_title(scene, title, "Speed against accuracy");
  for (std::size_t i = 0; i < kMeasures.size(); ++i) {
    const double left = kLeft + static_cast<double>(i % 2) * (kWidth + kGap);
    const double top = kTop + static_cast<double>(i / 2) * (kHeight + kRowGap);
    draw_panel(scene, {left, top, left + kWidth, top + kHeight}, points, kMeasures[i]);
  }
  const double bottom = scene.height - 44;
  add_text(scene, {24, bottom + 17},
           "Point: median of the repeats, with their range (pale) and the Monte Carlo error (dark). Full: "
           "error beyond "
           "chance, hollow: not. Ring: the default. Grey line: Pareto front.",
           Anchor::start, 12, kInk);
  add_text(scene, {24, bottom + 34}, missing(points), Anchor::start, 12, kInk);
  return scene;
}

namespace {

struct Series {
  std::string name;
  std::vector<WaitingPoint> points;
  Colour colour;
};

std::vector<Series> series_of(const std::vector<WaitingCurve>& curves) {
  std::vector<Series> result;
  for (const WaitingCurve& curve : curves) {
    const bool known = std::ranges::any_of(result, [&](const auto& s) { return s.name == curve.setting; });
    if (known) continue;
    const Colour colour = series_colour(result.size());
    result.push_back({curve.setting, median_curve(curves, curve.setting), colour});
  }
  return result;
}

/// Thin while there is the best match only.
void draw_series(Scene& scene, const Panel& panel, const Series& series) {
  const double width = series.name == kDefaultSetting ? 3 : 1.8;
  for (std::size_t i = 0; i + 1 < series.points.size(); ++i) {
    const WaitingPoint &from = series.points[i], &to = series.points[i + 1];
    scene.shapes.push_back(SceneLine{panel.at(from.seconds, from.error), panel.at(to.seconds, to.error),
                                     series.colour, to.draws > 0 ? width : 0.8});
  }
  for (const WaitingPoint& point : series.points)
    if (point.draws > 0)
      scene.shapes.push_back(SceneDisc{panel.at(point.seconds, point.error), 2.2, series.colour, kWhite, 0});
}

}  // namespace

Scene draw_waiting(const std::vector<WaitingCurve>& curves, double floor, const ChartTitle& title) {
  Scene scene;
  draw_title(scene, title, "What a waiting user has");
  const std::vector<Series> all = series_of(curves);
  std::vector<double> times, errors{floor};
  for (const Series& series : all)
    for (const WaitingPoint& point : series.points) {
      times.push_back(point.seconds);
      errors.push_back(point.error);
    }
  const Box area{70, 110, 1010, 690};
  const Panel panel(area, fitted_axis(times, 1.1, 1.05), fitted_axis(errors, 1.5, 1.3));
  panel.draw_frame(scene, "seconds since the start", "worst error of a mean / sd");
  const ScenePoint at_floor = panel.at(panel.x.low, floor);
  scene.shapes.push_back(SceneLine{at_floor, {area.right, at_floor.y}, kPale, 1});
  add_text(scene, {area.left + 6, at_floor.y - 5}, "the gold standard's own error", Anchor::start, 12, kPale);
  LabelPlacer placer({area.right + 4, area.top, scene.width - 8.0, area.bottom}, {});
  for (const Series& series : all) {
    draw_series(scene, panel, series);
    if (series.points.empty()) continue;
    const WaitingPoint& last = series.points.back();
    add_name(scene, placer, panel.at(last.seconds, last.error), series.name, kNameSize, series.colour,
             series.name == kDefaultSetting);
  }
  add_text(
      scene, {24, 756},
      "Thin: the best match so far, while there are no draws. Thick: the mean of all chains' draws so far. "
      "Medians of the repeats.",
      Anchor::start, 12, kInk);
  return scene;
}

}  // namespace patina
