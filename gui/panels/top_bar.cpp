#include "gui/panels/top_bar.h"

#include "gui/theme.h"

namespace patina {

void draw_top_bar(const PanelContext& context, const Rect& rect, const std::function<void()>& ask_to_open,
                  const std::function<void()>& ask_for_help) {
  const Session& session = context.session;
  const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::kWindow);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em, 0.5f * (rect.size.y - ImGui::GetFrameHeight())});
  ImGui::SetNextWindowPos(rect.position);
  ImGui::SetNextWindowSize(rect.size);
  ImGui::Begin("##top", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
  heading_text(context, "Patina");
  ImGui::PopStyleColor();
  ImGui::SameLine(0, 1.5f * em);
  if (ImGui::Button("Open...")) context.commands.push_back(ask_to_open);
  tooltip("Open a photo or a run (Ctrl+O)");
  const float help = button_width("?");
  if (session.has_run()) {
    const std::string text = "Kept in " + session.run().directory().string();
    const float room = ImGui::GetContentRegionMax().x - ImGui::GetItemRectMax().x - help - 4 * gap;
    const float width = std::min(room, ImGui::CalcTextSize(text.c_str()).x);
    align_right(width + help + 2 * gap);
    ImGui::AlignTextToFramePadding();
    elided_text(text, width, theme::kMuted);
    if (ImGui::IsItemClicked()) ImGui::SetClipboardText(session.run().directory().c_str());
    tooltip(session.run().directory().string() + "\nClick to copy");
  }
  align_right(help);
  if (ImGui::Button("?")) context.commands.push_back(ask_for_help);
  tooltip("Mouse, keys and words (?)");
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

}  // namespace patina
