#include "engine/chart/chart_points.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace patina {
namespace {

using Rows = std::vector<const ChartRow*>;

std::vector<double> values_of(const Rows& rows, const std::function<double(const ChartRow&)>& of) {
  std::vector<double> values;
  for (const ChartRow* row : rows) values.push_back(of(*row));
  return values;
}

ErrorSpread error_spread(const Rows& rows, WorstError Accuracy::*error) {
  constexpr double kByChance = 4;  // bars: the largest of some dozen normal errors stays below in 999 of 1000
  ErrorSpread result;
  result.value = spread_of(values_of(rows, [&](const auto& row) { return (row.accuracy.*error).value; }));
  result.bar = spread_of(values_of(rows, [&](const auto& row) { return (row.accuracy.*error).bar; })).median;
  const auto beyond = std::ranges::count_if(
      rows, [&](const ChartRow* row) { return (row->accuracy.*error).largest_bars > kByChance; });
  result.beyond_chance = beyond > 0 && 2 * beyond >= std::ssize(rows);
  return result;
}

ChartPoint point_of(const Rows& rows) {
  ChartPoint point;
  point.name = rows.front()->setting.name;
  point.is_default = point.name == kDefaultSetting;
  point.repeats = static_cast<int>(rows.size());
  point.seconds_per_draw = spread_of(values_of(rows, [](const auto& row) { return row.seconds_per_draw(); }));
  point.evaluations_per_draw =
      spread_of(values_of(rows, [](const auto& row) { return row.evaluations_per_draw(); }));
  point.mean = error_spread(rows, &Accuracy::mean);
  point.sd = error_spread(rows, &Accuracy::sd);
  point.wasserstein = error_spread(rows, &Accuracy::wasserstein);
  point.levels = error_spread(rows, &Accuracy::levels);
  return point;
}

}  // namespace

std::vector<ChartPoint> chart_points(const std::vector<ChartRow>& rows) {
  std::vector<Rows> by_setting;
  for (const ChartRow& row : rows) {
    const auto same = std::ranges::find_if(
        by_setting, [&](const Rows& other) { return other.front()->setting == row.setting; });
    if (same == by_setting.end())
      by_setting.push_back({&row});
    else
      same->push_back(&row);
  }
  std::vector<ChartPoint> points;
  for (const Rows& of_setting : by_setting) points.push_back(point_of(of_setting));
  return points;
}

std::vector<std::size_t> pareto_front(const std::vector<CostError>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(points[i].cost) && std::isfinite(points[i].error)) order.push_back(i);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::pair(points[a].cost, points[a].error) < std::pair(points[b].cost, points[b].error);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const bool first = front.empty();
    const bool alike = !first && points[i].cost == points[front.back()].cost &&
                       points[i].error == points[front.back()].error;
    if (first || alike || points[i].error < points[front.back()].error) front.push_back(i);
  }
  return front;
}

}  // namespace patina
