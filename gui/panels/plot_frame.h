#pragma once

#include "engine/material/parameter.h"
#include "gui/plot/plot_view.h"
#include "gui/window/layout.h"

namespace patina {

/// Room around a plot for its tick labels: left and below, in em.
inline constexpr float kTickRoomLeft = 3.6f;
inline constexpr float kTickRoomBelow = 1.6f;

/// A star with five points, dark around it so that it is seen on any ground.
void add_star(ImDrawList& list, ImVec2 centre, float radius, ImU32 color);

/// Draws a plot's ground and grid lines.
void draw_plot_ground(const PlotView& view, const ParameterTable& table, const PlotAxis& x,
                      const PlotAxis& y);

/// Draws the tick labels left of and below the plot. Labels that would overlap their neighbours are left out.
void draw_tick_labels(const PlotView& view, const ParameterTable& table, const PlotAxis& x,
                      const PlotAxis& y);

}  // namespace patina
