#pragma once

#include <string>
#include <vector>

#include "engine/chart/labels.h"
#include "engine/chart/log_axis.h"
#include "engine/chart/scene.h"

namespace patina {

inline constexpr Colour kInk{30, 32, 34}, kPale{120, 124, 128}, kFaint{226, 228, 230}, kWhite{255, 255, 255};

/// The colour of the i-th of several things; repeats after ten (Okabe & Ito's and three more).
Colour series_colour(std::size_t i);

/// A part of a drawing with two logarithmic axes.
struct Panel {
  Box area;  ///< between the axes
  LogAxis x, y;

  /// @param x, y  their pixels are set from the area
  Panel(const Box& area, LogAxis x, LogAxis y);

  ScenePoint at(double x_value, double y_value) const { return {x.pixel(x_value), y.pixel(y_value)}; }

  /// Frame, ticks and the axes' names: y's above, x's below.
  void draw_frame(Scene& scene, const std::string& x_name, const std::string& y_name) const;
};

void add_text(Scene& scene, const ScenePoint& at, const std::string& text, Anchor anchor, double size,
              const Colour& colour, bool strong = false);

/// A name beside a point, joined to it by a thin line where it is not next to it.
void add_name(Scene& scene, LabelPlacer& placer, const ScenePoint& point, const std::string& name,
              double size, const Colour& colour, bool strong);

}  // namespace patina
