#include "gui/panels/cost_plot.h"

#include <string>

#include "engine/chart/labels.h"
#include "engine/chart/log_axis.h"
#include "gui/panels/panel.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

/// Where a chart lies on the screen.
struct CostPlot {
  Rect area;
  LogAxis x, y;

  ImVec2 at(const DrawingCost& cost) const {
    return {static_cast<float>(x.pixel(cost.seconds)), static_cast<float>(y.pixel(cost.error))};
  }
};

CostPlot plot_in(const CostChart& chart, const Rect& rect) {
  const float em = ImGui::GetFontSize(), left = 3.4f * em, right = em, above = 1.6f * em, below = 3.2f * em;
  std::vector<double> seconds, errors;
  for (const DrawingCost& cost : chart.costs) {
    seconds.push_back(cost.seconds);
    errors.push_back(cost.error);
  }
  CostPlot plot{{{rect.position.x + left, rect.position.y + above},
                 {rect.size.x - left - right, rect.size.y - above - below}},
                fitted_axis(seconds, 1.4, 1.8),
                fitted_axis(errors, 1.5, 1.5)};
  plot.x.pixel_of_low = plot.area.position.x;
  plot.x.pixel_of_high = plot.area.position.x + plot.area.size.x;
  plot.y.pixel_of_low = plot.area.position.y + plot.area.size.y;
  plot.y.pixel_of_high = plot.area.position.y;
  return plot;
}

void draw_frame(const CostPlot& plot) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize();
  const ImVec2 low = plot.area.position;
  const ImVec2 high{low.x + plot.area.size.x, low.y + plot.area.size.y};
  list.AddRectFilled(low, high, theme::kWell);
  for (const Tick& tick : log_ticks(plot.x.low, plot.x.high)) {
    const auto at = static_cast<float>(plot.x.pixel(tick.value));
    list.AddLine({at, low.y}, {at, high.y}, theme::kGrid);
    const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
    list.AddText({at - 0.5f * width, high.y + 0.3f * em}, theme::kMuted, tick.label.c_str());
  }
  for (const Tick& tick : log_ticks(plot.y.low, plot.y.high)) {
    const auto at = static_cast<float>(plot.y.pixel(tick.value));
    list.AddLine({low.x, at}, {high.x, at}, theme::kGrid);
    const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
    list.AddText({low.x - width - 0.4f * em, at - 0.5f * em}, theme::kMuted, tick.label.c_str());
  }
  list.AddText({low.x, low.y - 1.5f * em}, theme::kMuted, "Worst error of an average, in spreads");
  const char* cost = "Seconds for each independent draw";
  list.AddText({high.x - ImGui::CalcTextSize(cost).x, high.y + 1.7f * em}, theme::kMuted, cost);
}

void draw_front(const CostPlot& plot, const CostChart& chart) {
  for (std::size_t i = 0; i + 1 < chart.front.size(); ++i)
    ImGui::GetWindowDrawList()->AddLine(plot.at(chart.costs[chart.front[i]]),
                                        plot.at(chart.costs[chart.front[i + 1]]), theme::kLine,
                                        0.15f * ImGui::GetFontSize());
}

void draw_point(const CostPlot& plot, const DrawingCost& cost, bool own) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize(), radius = 0.36f * em;
  const ImU32 color = own ? theme::kAccent : theme::kText;
  const ImVec2 at = plot.at(cost);
  list.AddCircleFilled(at, radius, cost.beyond_chance ? color : static_cast<ImU32>(theme::kWell));
  list.AddCircle(at, radius, color, 0, 0.12f * em);
  if (own) list.AddCircle(at, 1.8f * radius, color, 0, 0.12f * em);
}

void draw_names(const CostPlot& plot, const CostChart& chart, const std::optional<std::size_t>& own) {
  const double room = 0.7 * ImGui::GetFontSize();
  std::vector<Box> taken;
  for (const DrawingCost& cost : chart.costs) {
    const ImVec2 at = plot.at(cost);
    taken.push_back({at.x - room, at.y - room, at.x + room, at.y + room});
  }
  const Rect& area = plot.area;
  LabelPlacer placer(
      {area.position.x, area.position.y, area.position.x + area.size.x, area.position.y + area.size.y},
      std::move(taken));
  for (std::size_t i = 0; i < chart.costs.size(); ++i) {
    const std::string& name = chart.costs[i].setting.name;
    const ImVec2 size = ImGui::CalcTextSize(name.c_str()), at = plot.at(chart.costs[i]);
    const Box box = placer.place({at.x, at.y}, size.x, size.y);
    ImGui::GetWindowDrawList()->AddText({static_cast<float>(box.left), static_cast<float>(box.top)},
                                        own == i ? theme::kAccent : theme::kText, name.c_str());
  }
}

}  // namespace

void draw_cost_plot(const CostChart& chart, const std::optional<std::size_t>& own, const Rect& rect) {
  const CostPlot plot = plot_in(chart, rect);
  draw_frame(plot);
  draw_front(plot, chart);
  for (std::size_t i = 0; i < chart.costs.size(); ++i) draw_point(plot, chart.costs[i], own == i);
  draw_names(plot, chart, own);
}

}  // namespace patina
