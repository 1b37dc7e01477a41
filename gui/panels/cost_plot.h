#pragma once

#include <optional>

#include "gui/plot/cost_chart.h"
#include "gui/window/layout.h"

namespace patina {

/// A chart of ways to draw, both axes logarithmic: to the left is cheap, down is right. Full points are off
/// by more than chance; the line joins those that none beats.
/// @param own  the run's way, if it is among the chart's: in the accent colour, with a ring
void draw_cost_plot(const CostChart& chart, const std::optional<std::size_t>& own, const Rect& rect);

}  // namespace patina
