#include "gui/plot/plot_axis.h"

#include <algorithm>
#include <cmath>

#include "gui/words.h"

namespace patina {

std::vector<PlotAxis> plot_axes(const ParameterTable& table) {
  std::vector<PlotAxis> axes;
  for (std::size_t i = 0; i < table.continuous.size(); ++i) axes.push_back({PlotAxis::Kind::continuous, i});
  for (std::size_t i = 0; i < table.discrete.size(); ++i) axes.push_back({PlotAxis::Kind::discrete, i});
  axes.push_back({PlotAxis::Kind::log_posterior, 0});
  return axes;
}

std::string axis_label(const ParameterTable& table, const PlotAxis& axis) {
  if (axis.kind == PlotAxis::Kind::log_posterior) return "Match (log posterior)";
  if (axis.kind == PlotAxis::Kind::iteration) return "Step";
  if (axis.kind == PlotAxis::Kind::discrete) return parameter_label(table.discrete[axis.index].name);
  const Parameter& parameter = table.continuous[axis.index];
  const std::string label = parameter_label(parameter.name);
  return parameter.unit.empty() ? label : label + " (" + parameter.unit + ")";
}

std::string tick_label(const ParameterTable& table, const PlotAxis& axis, double value) {
  if (axis.kind == PlotAxis::Kind::iteration) return value < 0 ? "" : count_text(std::llround(value));
  if (axis.kind != PlotAxis::Kind::discrete) return number_text(value, 4);
  const auto& levels = table.discrete[axis.index].levels;
  const double level = std::round(value);
  if (std::abs(value - level) > 1e-9 || level < 0 || level >= static_cast<double>(levels.size())) return {};
  return levels[static_cast<std::size_t>(level)];
}

std::vector<double> round_ticks(const PlotRange& range, int most) {
  if (!(range.span() > 0) || !std::isfinite(range.span()) || most < 1) return {};
  const double least_step = range.span() / most;
  const double decade = std::pow(10.0, std::floor(std::log10(least_step)));
  double step = 10 * decade;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least_step) {
      step = factor * decade;
      break;
    }
  }
  std::vector<double> ticks;
  const double first = std::ceil(range.low / step);
  for (int i = 0; i < most && (first + i) * step <= range.high; ++i) {
    const double tick = (first + i) * step;
    ticks.push_back(std::abs(tick) < 1e-9 * step ? 0.0 : tick);
  }
  return ticks;
}

PlotRange padded(const PlotRange& range) {
  double margin = 0.06 * range.span();
  if (!(margin > 0)) margin = std::max(0.05 * std::abs(range.low), 1e-3);
  return {range.low - margin, range.high + margin};
}

PlotRange followed(const PlotRange& view, const PlotRange& data) {
  const bool inside = data.low >= view.low && data.high <= view.high;
  return inside && data.span() >= 0.5 * view.span() ? view : padded(data);
}

}  // namespace patina
