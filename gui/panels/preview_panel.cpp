#include "gui/panels/preview_panel.h"

#include <algorithm>

#include "gui/theme.h"

namespace patina {

void PreviewPanel::show(const MaterialMaps& maps) {
  renderer_.set_maps(maps);
  renderer_.render();
}

void PreviewPanel::draw(const PanelContext& context, const Rect& rect, const ShownDraw& shown,
                        const Texture* photo, const std::string& problem, bool waiting) {
  const PanelScope panel("Render", rect, context, ImGuiWindowFlags_NoScrollbar);
  ImGui::SameLine();
  const float width = 5.6f * ImGui::GetFontSize();
  const float room_for_title = ImGui::GetContentRegionAvail().x - width - ImGui::GetStyle().ItemSpacing.x;
  elided_text(shown_draw_title(shown) + (waiting ? " ..." : ""), room_for_title, theme::kMuted);
  align_right(width);
  ImGui::SetNextItemWidth(width);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 0});
  draw_resolution_choice("##resolution", {256, 512, 1024, 2048}, resolution_);
  ImGui::PopStyleVar();
  tooltip("Pixels a side of the render; the pattern stays the same");

  const Rect room{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail()};
  if (!problem.empty()) return centred_hint(room, problem);
  if (!has_render()) return centred_hint(room, "The first render appears in a moment");
  const Rect square = centred_square(room);
  ImGui::SetCursorScreenPos(square.position);
  ImGui::InvisibleButton("render", square.size);
  const ImVec2 end{square.position.x + square.size.x, square.position.y + square.size.y};
  ImGui::GetWindowDrawList()->AddImage(renderer_.texture().imgui_id(), square.position, end);
  if (photo == nullptr) return;
  // The cursor is the hint: a tooltip would lie on the render that is being judged.
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive()) draw_wipe(square, *photo);
}

void PreviewPanel::draw_wipe(const Rect& square, const Texture& photo) const {
  const ImVec2 corner = square.position;
  const float x = std::clamp(ImGui::GetIO().MousePos.x, corner.x, corner.x + square.size.x),
              bottom = corner.y + square.size.y;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddImage(photo.imgui_id(), corner, {x, bottom}, {0, 0}, {(x - corner.x) / square.size.x, 1});
  list.AddRectFilled({x - 1, corner.y}, {x + 1, bottom}, theme::kText);
}

}  // namespace patina
