#include "gui/panels/plot_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "gui/window/theme.h"

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

constexpr int kStarCorners = 10;

std::array<ImVec2, kStarCorners> star(ImVec2 centre, float radius) {
  std::array<ImVec2, kStarCorners> corners;
  for (int i = 0; i < kStarCorners; ++i) {
    const double turn = 2 * M_PI * i / kStarCorners, reach = i % 2 == 0 ? radius : 0.45 * radius;
    corners[static_cast<std::size_t>(i)] = {centre.x + static_cast<float>(reach * std::sin(turn)),
                                            centre.y - static_cast<float>(reach * std::cos(turn))};
  }
  return corners;
}

}  // namespace

void add_star(ImDrawList& list, ImVec2 centre, float radius, ImU32 color) {
  const auto corners = star(centre, radius);
  // A star is not convex: its middle and the triangles to its points are.
  for (std::size_t i = 0; i < kStarCorners; i += 2) {
    const ImVec2 before = corners[(i + kStarCorners - 1) % kStarCorners], after = corners[i + 1];
    list.AddQuadFilled(centre, before, corners[i], after, color);
  }
  list.AddPolyline(corners.data(), kStarCorners, IM_COL32(0, 0, 0, 200), ImDrawFlags_Closed, 0.25f * radius);
}

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
