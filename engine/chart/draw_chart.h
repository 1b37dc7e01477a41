#pragma once

#include <string>
#include <vector>

#include "engine/chart/chart_points.h"
#include "engine/chart/chart_title.h"
#include "engine/chart/scene.h"
#include "engine/chart/waiting.h"

namespace patina {

/// Cost of an effective draw against error: errors of means, of sds and of whole distributions over seconds,
/// and that of means over evaluations. Per panel the Pareto front as a line, each point named, the default
/// marked; settings without a point are named below.
Scene draw_chart(const std::vector<ChartPoint>& points, const ChartTitle& title);

/// Error against the time that someone has waited, a line per setting; `floor`: the gold standard's own
/// error, below which nothing can be told apart.
Scene draw_waiting(const std::vector<WaitingCurve>& curves, double floor, const ChartTitle& title);

}  // namespace patina
