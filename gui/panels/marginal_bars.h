#pragma once

#include "gui/plot/histogram.h"
#include "gui/plot/plot_view.h"

namespace patina {

/// Draws the histogram of a plot's x axis along its upper edge, upwards; `room` pixels for the highest bar.
/// The share that is marked stands out.
void draw_bars_above(const PlotView& view, const Histogram& bars, float room);

/// Likewise that of the y axis along the right edge, to the right.
void draw_bars_beside(const PlotView& view, const Histogram& bars, float room);

}  // namespace patina
