#pragma once

#include <string>
#include <vector>

#include "engine/chart/chart_row.h"
#include "engine/chart/spread.h"

namespace patina {

/// An error of a setting over its repeats.
struct ErrorSpread {
  Spread value;
  double bar = 0;              ///< median of the repeats' Monte Carlo standard errors
  bool beyond_chance = false;  ///< in half of the repeats or more, the largest is above four bars
};

/// A setting over its repeats: a point of each panel.
struct ChartPoint {
  std::string name;
  bool is_default = false;
  int repeats = 0;
  Spread seconds_per_draw, evaluations_per_draw;
  ErrorSpread mean, sd, wasserstein, levels;
};

/// One point per setting, in order of first appearance.
std::vector<ChartPoint> chart_points(const std::vector<ChartRow>& rows);

/// What a point costs and how far off it is; not finite: it takes no part.
struct CostError {
  double cost = 0, error = 0;
};

/// The points that no other one beats: none costs no more and errs no more, less in one of both. In order of
/// cost. Of points that are alike all are kept.
std::vector<std::size_t> pareto_front(const std::vector<CostError>& points);

}  // namespace patina
