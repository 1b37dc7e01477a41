#include "gui/panels/plot_frame.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gui/theme.h"

namespace patina {
namespace {

std::vector<double> ticks_of(const PlotAxis& axis, const PlotRange& range, float pixels, float pixels_apart) {
  auto ticks = round_ticks(range, std::max(2, static_cast<int>(pixels / pixels_apart)));
  if (axis.kind == PlotAxis::Kind::discrete)
    std::erase_if(ticks, [](double tick) { return tick != std::round(tick); });
  return ticks;
}

std::vector<double> x_ticks(const PlotView& view, const PlotAxis& axis) {
  return ticks_of(axis, view.x, view.width, 5.5f * ImGui::GetFontSize());
}

std::vector<double> y_ticks(const PlotView& view, const PlotAxis& axis) {
  return ticks_of(axis, view.y, view.height, 3.5f * ImGui::GetFontSize());
}

}  // namespace

void draw_plot_ground(const PlotView& view, const ParameterTable& table, const PlotAxis& x,
                      const PlotAxis& y) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float right = view.left + view.width, bottom = view.top + view.height;
  list.AddRectFilled({view.left, view.top}, {right, bottom}, theme::kWell);
  for (const double tick : x_ticks(view, x)) {
    if (tick_label(table, x, tick).empty()) continue;
    const float at = std::floor(view.pixel_of_x(tick));
    list.AddRectFilled({at, view.top}, {at + 1, bottom}, theme::kGrid);
  }
  for (const double tick : y_ticks(view, y)) {
    if (tick_label(table, y, tick).empty()) continue;
    const float at = std::floor(view.pixel_of_y(tick));
    list.AddRectFilled({view.left, at}, {right, at + 1}, theme::kGrid);
  }
}

void draw_tick_labels(const PlotView& view, const ParameterTable& table, const PlotAxis& x,
                      const PlotAxis& y) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize();
  float taken = -1e9f;
  for (const double tick : x_ticks(view, x)) {
    const std::string text = tick_label(table, x, tick);
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    const float left = std::min(view.pixel_of_x(tick) - 0.5f * width, view.left + view.width - width);
    if (text.empty() || left < taken) continue;
    list.AddText({left, view.top + view.height + 0.35f * em}, theme::kMuted, text.c_str());
    taken = left + width + 0.6f * em;
  }
  for (const double tick : y_ticks(view, y)) {
    const std::string text = tick_label(table, y, tick);
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    list.AddText({view.left - 0.5f * em - width, view.pixel_of_y(tick) - 0.55f * em}, theme::kMuted,
                 text.c_str());
  }
}

}  // namespace patina
