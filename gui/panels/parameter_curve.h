#pragma once

#include <cstdint>
#include <span>

#include "engine/material/parameter.h"
#include "gui/plot/plot_axis.h"

namespace patina {

/// A parameter at a glance: what was assumed as a curve, what the draws say as bars over it (each as high as
/// the row), and a mark at the value that is shown.
struct ParameterCurve {
  TruncatedNormal prior;
  PlotRange range;                           ///< from edge to edge
  std::span<const std::uint32_t> histogram;  ///< over the range; empty without draws
  double value = 0;
  bool is_weak = false;    ///< the draws say nothing that was not assumed
  bool is_locked = false;  ///< at `value`: nothing is assumed
};

/// Draws it over the rest of the line, as a button. @return whether it was clicked
bool draw_parameter_curve(const char* id, const ParameterCurve& curve);

/// A padlock as a button, one line high. @return whether it was clicked
bool draw_lock(const char* id, bool locked);

}  // namespace patina
