#include "gui/panels/parameter_curve.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gui/panels/panel.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr int kPoints = 41;  // of the prior's curve

/// Where the curve is drawn.
struct Field {
  ImVec2 corner, size;
  PlotRange range;

  float x(double value) const {
    return corner.x + size.x * static_cast<float>(std::clamp((value - range.low) / range.span(), 0.0, 1.0));
  }
  float y(double height) const { return corner.y + size.y * static_cast<float>(1 - height); }
};

void draw_prior(ImDrawList& list, const Field& field, const TruncatedNormal& prior) {
  const auto exponent = [&](double value) { return -0.5 * std::pow((value - prior.mean) / prior.sd, 2); };
  const double top = exponent(std::clamp(prior.mean, prior.low, prior.high));
  std::array<ImVec2, kPoints> points;
  for (int i = 0; i < kPoints; ++i) {
    const double value = prior.low + (prior.high - prior.low) * i / (kPoints - 1);
    points[static_cast<std::size_t>(i)] = {field.x(value), field.y(0.92 * std::exp(exponent(value) - top))};
  }
  const float floor = field.y(0);
  list.AddLine({points.front().x, floor}, points.front(), theme::kMuted);
  list.AddPolyline(points.data(), kPoints, theme::kMuted, ImDrawFlags_None, 1);
  list.AddLine(points.back(), {points.back().x, floor}, theme::kMuted);
}

void draw_bars(ImDrawList& list, const Field& field, std::span<const std::uint32_t> counts, ImU32 color) {
  if (counts.empty()) return;
  const double peak = std::max<std::uint32_t>(1, std::ranges::max(counts));
  const float width = field.size.x / static_cast<float>(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const float x = field.corner.x + width * static_cast<float>(i);
    list.AddRectFilled({x, field.y(std::max(0.06, 0.92 * counts[i] / peak))}, {x + width, field.y(0)}, color);
  }
}

}  // namespace

bool draw_parameter_curve(const char* id, const ParameterCurve& curve) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x), 1.25f * ImGui::GetTextLineHeight()};
  const bool clicked = picture_button(id, size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Field field{corner, size, curve.range};
  const ImU32 ground = ImGui::IsItemHovered() ? theme::kLine : theme::kWell;
  list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, ground, 0.15f * size.y);
  draw_bars(list, field, curve.histogram, curve.is_weak ? theme::kWarning : theme::kAccent);
  if (!curve.is_locked) draw_prior(list, field, curve.prior);
  const float mark = field.x(curve.value);
  list.AddRectFilled({mark - 1, corner.y}, {mark + 1, corner.y + size.y}, theme::kText);
  return clicked;
}

bool draw_lock(const char* id, bool locked) {
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const bool clicked = picture_button(id, {line, line});
  const ImU32 color = locked ? theme::kAccent : ImGui::IsItemHovered() ? theme::kText : theme::kLine;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float x = corner.x + 0.5f * line, y = corner.y + 0.55f * line, half = 0.26f * line;
  list.AddRectFilled({x - half, y - 0.06f * line}, {x + half, y + 0.36f * line}, color, 0.08f * line);
  // The shackle: closed, or turned aside.
  const float pi = 3.14159265f, turned = locked ? 0 : 0.3f * line;
  list.PathArcTo({x + turned, y - 0.12f * line}, 0.17f * line, pi, 2 * pi, 10);
  list.PathLineTo({x + turned + 0.17f * line, y - (locked ? 0.06f : 0.1f) * line});
  list.PathStroke(color, ImDrawFlags_None, 0.1f * line);
  list.AddLine({x + turned - 0.17f * line, y - 0.12f * line}, {x + turned - 0.17f * line, y - 0.04f * line},
               color, 0.1f * line);
  return clicked;
}

}  // namespace patina
