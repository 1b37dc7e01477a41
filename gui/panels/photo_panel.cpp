#include "gui/panels/photo_panel.h"

#include "gui/theme.h"

namespace patina {

void PhotoPanel::draw(const PanelContext& context, const Rect& rect,
                      const std::function<void()>& ask_to_open) {
  const Session& session = context.session;
  const PanelScope panel("Photo", rect, context, ImGuiWindowFlags_NoScrollbar);
  if (session.has_photo()) {
    if (version_ != session.photo_version()) picture_ = Texture::picture(gl_, session.photo().image);
    version_ = session.photo_version();
    ImGui::SameLine();
    elided_text(session.photo_name(), ImGui::GetContentRegionAvail().x, theme::kMuted);
  }
  const Rect room{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail()};
  if (!picture_) return draw_invitation(context, room, ask_to_open);
  const Rect square = centred_square(room);
  ImGui::SetCursorScreenPos(square.position);
  ImGui::Image(picture_->imgui_id(), square.size);
  const Photo& photo = session.photo();
  tooltip("The central square of " + std::to_string(photo.original_width) + " by " +
          std::to_string(photo.original_height) + " pixels is compared with the renders.");
}

void PhotoPanel::draw_invitation(const PanelContext& context, const Rect& room,
                                 const std::function<void()>& ask_to_open) {
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = room.position, size = room.size;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, theme::kWell, 0.4f * em);
  list.AddRect(corner, {corner.x + size.x, corner.y + size.y}, theme::kLine, 0.4f * em);
  centred_hint({corner, {size.x, size.y - 3 * em}}, "Drop a flash photo of a surface here");
  ImGui::SetCursorScreenPos({corner.x + 0.5f * (size.x - button_width("Open...")), corner.y + 0.5f * size.y});
  if (primary_button("Open...")) context.commands.push_back(ask_to_open);
}

}  // namespace patina
