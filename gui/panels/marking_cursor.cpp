#include "gui/panels/marking_cursor.h"

#include <imgui.h>

#include <algorithm>

#include "gui/panels/keys.h"
#include "gui/panels/marking_gesture.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr double kStep = 1.0 / 30, kFineStep = 1.0 / 180;  // of the plot

}  // namespace

void MarkingCursor::handle(ExplorerModel& model, const PlotAxis& x, const PlotAxis& y, const PlotView& view,
                           MarkingTool tool, double reach) {
  if (!active() || keys_are_elsewhere()) return;
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 arrows = pressed_arrows();
  const double step = io.KeyShift ? kFineStep : kStep;
  if (arrows.x != 0 || arrows.y != 0) cursor_.move(step * arrows.x, -step * arrows.y, view);
  if (!enter_pressed() && !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Space), false)) return;
  switch (cursor_.set_corner(tool)) {
    case PlotCursor::Step::opened:
      return;
    case PlotCursor::Step::closed:
      return model.mark(model.inside(x, y, cursor_.finished()), marking_of(io));
    case PlotCursor::Step::pointed:
      if (const auto draw =
              model.nearest(x, y, cursor_.place(), {view.x_per_pixel(), view.y_per_pixel()}, reach))
        model.select(draw);
  }
}

void MarkingCursor::draw(const PlotView& view, MarkingTool tool) const {
  if (!active()) return;
  const float em = ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at{view.pixel_of_x(cursor_.place().x), view.pixel_of_y(cursor_.place().y)};
  list.AddLine({at.x, view.top}, {at.x, view.top + view.height}, theme::kLine);
  list.AddLine({view.left, at.y}, {view.left + view.width, at.y}, theme::kLine);
  list.AddCircle(at, 0.4f * em, theme::kAccent, 0, 0.14f * em);
  std::vector<ImVec2> pixels;
  for (const PlotPlace& place : cursor_.outline(tool))
    pixels.emplace_back(view.pixel_of_x(place.x), view.pixel_of_y(place.y));
  list.AddPolyline(pixels.data(), static_cast<int>(pixels.size()), theme::kText, ImDrawFlags_Closed,
                   0.1f * em);
  const char* help = tool == MarkingTool::box
                         ? "Arrows move, Enter sets two corners, Esc ends"
                         : "Arrows move, Enter sets corners, twice in one place closes, Esc ends";
  list.AddText({view.left + 0.4f * em, view.top + 0.3f * em}, theme::kMuted, help);
}

}  // namespace patina
