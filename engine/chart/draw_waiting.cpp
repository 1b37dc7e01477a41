#include <algorithm>

#include "engine/chart/draw_chart.h"
#include "engine/chart/panel.h"

namespace patina {
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
    add_name(scene, placer, panel.at(last.seconds, last.error), series.name, 12.5, series.colour,
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
