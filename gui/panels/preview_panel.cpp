#include "gui/panels/preview_panel.h"

#include <algorithm>
#include <cmath>

#include "gui/panels/preview_controls.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr float kRadiansPerPixel = 0.008f;

ImVec2 end_of(const Rect& rect) { return {rect.position.x + rect.size.x, rect.position.y + rect.size.y}; }

/// A word in the corner of a picture, readable on whatever lies beneath.
void label(ImVec2 corner, const char* text, bool to_the_left) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float pad = 0.3f * ImGui::GetFontSize();
  const ImVec2 size = ImGui::CalcTextSize(text);
  const float x = to_the_left ? corner.x - size.x - 3 * pad : corner.x + pad, y = corner.y + pad;
  list.AddRectFilled({x, y}, {x + size.x + 2 * pad, y + size.y + pad}, IM_COL32(0, 0, 0, 140), pad);
  list.AddText({x + pad, y + 0.5f * pad}, IM_COL32(255, 255, 255, 230), text);
}

}  // namespace

void PreviewPanel::draw_title(const ShownDraw& shown, bool waiting) {
  ImGui::SameLine();
  const float width = 5.6f * ImGui::GetFontSize();
  const float room_for_title = ImGui::GetContentRegionAvail().x - width - ImGui::GetStyle().ItemSpacing.x;
  elided_text(shown_draw_title(shown) + (waiting ? " ..." : ""), room_for_title, theme::kMuted);
  draw_preview_resolution(view_, width);
}

void PreviewPanel::draw(const PanelContext& context, const Rect& rect, const ShownDraw& shown,
                        const Texture* photo, const std::string& problem, bool waiting) {
  const PanelScope panel("Render", rect, context, ImGuiWindowFlags_NoScrollbar);
  draw_title(shown, waiting);
  draw_preview_controls(view_, photo != nullptr);
  const bool difference = photo != nullptr && view_.effective_comparison() == Comparison::difference;
  Rect room{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail()};
  if (difference) room.size.y -= ImGui::GetFrameHeightWithSpacing();
  if (problem.empty()) {
    draw_picture(room, photo);
  } else {
    centred_hint(room, problem);
  }
  if (!difference) return;
  ImGui::SetCursorScreenPos({room.position.x, end_of(room).y + ImGui::GetStyle().ItemSpacing.y});
  draw_difference_controls(view_);
}

void PreviewPanel::draw_picture(const Rect& room, const Texture* photo) {
  room_ = room;
  square_ = centred_square(room);
  if (square_.size.x < 1) return;
  const int pixels =
      std::max(1, static_cast<int>(square_.size.x * ImGui::GetIO().DisplayFramebufferScale.x + 0.5f));
  const Texture* picture = canvas_.picture(view_, pixels);
  if (picture == nullptr) {
    const bool lacks = is_map(view_.subject) && has_render();
    return centred_hint(room,
                        lacks ? "This material has no such map" : "The first render appears in a moment");
  }
  ImGui::SetCursorScreenPos(square_.position);
  mouse_area("render", square_.size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  handle_mouse(photo != nullptr);
  draw_comparison(*picture, photo, pixels);
}

void PreviewPanel::draw_comparison(const Texture& render, const Texture* photo, int pixels) {
  const Comparison comparison = photo != nullptr ? view_.effective_comparison() : Comparison::off;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (comparison == Comparison::side_by_side)
    return draw_side_by_side(render, canvas_.photo(*photo, view_, pixels));
  const bool flickers = comparison == Comparison::flicker;
  const Texture* shown = &render;
  if (comparison == Comparison::difference) shown = &canvas_.difference(*photo, view_, pixels);
  const bool shows_photo = flickers && flicker_shows_photo(ImGui::GetTime());
  if (shows_photo) shown = &canvas_.photo(*photo, view_, pixels);
  list.AddImage(shown->imgui_id(), square_.position, end_of(square_));
  if (comparison == Comparison::wipe) draw_wipe(canvas_.photo(*photo, view_, pixels));
  if (flickers) label(square_.position, shows_photo ? "Photo" : "Render", false);
}

void PreviewPanel::draw_side_by_side(const Texture& render, const Texture& photo) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto place = [&](const Texture& texture, float x, const char* word) {
    const Rect half{{x, room_.position.y}, {0.5f * room_.size.x - 1, room_.size.y}};
    const Rect square = centred_square(half);
    list.AddImage(texture.imgui_id(), square.position, end_of(square));
    label(square.position, word, false);
  };
  place(photo, room_.position.x, "Photo");
  place(render, room_.position.x + 0.5f * room_.size.x + 1, "Render");
}

void PreviewPanel::draw_wipe(const Texture& photo) const {
  const ImVec2 corner = square_.position, end = end_of(square_);
  const float x = corner.x + view_.wipe * square_.size.x, grip = 0.45f * ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddImage(photo.imgui_id(), corner, {x, end.y}, {0, 0}, {view_.wipe, 1});
  list.AddRectFilled({x - 1, corner.y}, {x + 1, end.y}, IM_COL32_WHITE);
  const float y = 0.5f * (corner.y + end.y);
  list.AddCircleFilled({x, y}, grip, IM_COL32_WHITE);
  list.AddCircle({x, y}, grip, IM_COL32(0, 0, 0, 120));
  const float narrow = 0.16f * square_.size.x;
  if (view_.wipe * square_.size.x > narrow) label(corner, "Photo", false);
  if ((1 - view_.wipe) * square_.size.x > narrow) label({end.x, corner.y}, "Render", true);
}

void PreviewPanel::handle_mouse(bool can_compare) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
  if (!hovered && !active) return;
  const float x = (io.MousePos.x - square_.position.x) / square_.size.x;
  const float y = (io.MousePos.y - square_.position.y) / square_.size.y;
  if (is_shape(view_.subject)) {
    if (active && ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
      view_.orbit.turn(-kRadiansPerPixel * io.MouseDelta.x, kRadiansPerPixel * io.MouseDelta.y);
    } else {
      view_.light = light_under(2 * x - 1, 1 - 2 * y);
    }
    view_.orbit.approach(io.MouseWheel);
    return;
  }
  if (!can_compare || view_.subject != Subject::photographed) return;
  if (view_.comparison != Comparison::off && view_.comparison != Comparison::wipe) return;
  // The cursor is the hint: a tooltip would lie on the render that is being judged.
  ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (active && ImGui::IsMouseDown(ImGuiMouseButton_Left)) view_.wipe_to(x);
}

}  // namespace patina
