#pragma once

#include <string>

#include "engine/chart/scene.h"

namespace patina {

/// What stands above a chart.
struct ChartTitle {
  std::string target;  ///< what was charted
  std::string gold;    ///< whether the gold standard is one
  std::string how;     ///< budget, repeats, machine
};

/// In the scene's first 70 pixels. @param what  the chart shows
void draw_title(Scene& scene, const ChartTitle& title, const std::string& what);

}  // namespace patina
