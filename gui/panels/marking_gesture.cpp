#include "gui/panels/marking_gesture.h"

#include <imgui.h>

#include <vector>

#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr std::size_t kMarkedLive = 200'000;  // draws, above which marking waits for the button's release

}  // namespace

Marking marking_of(const ImGuiIO& io) {
  return io.KeyShift ? Marking::add : io.KeyCtrl ? Marking::remove : Marking::replace;
}

bool MarkingGesture::handle(ExplorerModel& model, const PlotAxis& x, const PlotAxis& y, const PlotView& view,
                            MarkingTool tool) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto place = [&](ImVec2 at) { return PlotPlace{view.x_of_pixel(at.x), view.y_of_pixel(at.y)}; };
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
    if (!outline_.active()) {
      outline_.begin(tool, place(io.MouseClickedPos[ImGuiMouseButton_Left]));
      marked_before_ = model.marked();
    }
    outline_.extend(place(io.MousePos));
  }
  const bool released = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
  const bool moved = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
  if (outline_.active() && (released || (moved && model.draws().size() <= kMarkedLive))) {
    model.mark(marked_before_, Marking::replace);
    model.mark(model.inside(x, y, outline_.outline()), marking_of(io));
  }
  const bool clicked = released && !outline_.active();
  if (!ImGui::IsItemActive()) outline_.end();
  return clicked;
}

void MarkingGesture::draw(const PlotView& view) const {
  if (!outline_.active()) return;
  std::vector<ImVec2> pixels;
  for (const PlotPlace& place : outline_.outline())
    pixels.emplace_back(view.pixel_of_x(place.x), view.pixel_of_y(place.y));
  ImGui::GetWindowDrawList()->AddPolyline(pixels.data(), static_cast<int>(pixels.size()), theme::kText,
                                          ImDrawFlags_Closed, 0.1f * ImGui::GetFontSize());
}

}  // namespace patina
