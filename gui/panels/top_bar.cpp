#include "gui/panels/top_bar.h"

#include <algorithm>
#include <string>

#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr const char* kCommands = "Commands";

void draw_recent(const PanelContext& context, const std::vector<std::filesystem::path>& recent,
                 const TopBarCommands& commands) {
  ImGui::SameLine(0, 1);
  ImGui::BeginDisabled(recent.empty());
  if (ImGui::ArrowButton("##recent", ImGuiDir_Down)) ImGui::OpenPopup("recent");
  ImGui::EndDisabled();
  tooltip(recent.empty() ? "What you open will be listed here" : "What was open before");
  if (!ImGui::BeginPopup("recent")) return;
  for (std::size_t i = 0; i < recent.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::MenuItem(recent[i].filename().string().c_str()))
      context.commands.push_back([open = commands.open, file = recent[i]] { open(file); });
    tooltip(recent[i].string());
    ImGui::PopID();
  }
  ImGui::EndPopup();
}

/// Where the run is kept, up to `room` wide before what stands `before_edge` from the right edge.
void draw_directory(const std::string& directory, float room, float before_edge) {
  const std::string text = "Kept in " + directory;
  const float width = std::min(room, ImGui::CalcTextSize(text.c_str()).x);
  align_right(width + before_edge);
  ImGui::AlignTextToFramePadding();
  elided_text(text, width, theme::kMuted);
  if (ImGui::IsItemClicked()) ImGui::SetClipboardText(directory.c_str());
  tooltip(directory + "\nClick to copy");
}

void draw_contents(const PanelContext& context, const std::vector<std::filesystem::path>& recent,
                   const TopBarCommands& commands) {
  const Session& session = context.session;
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
  heading_text(context, "Patina");
  ImGui::PopStyleColor();
  ImGui::SameLine(0, 1.5f * ImGui::GetFontSize());
  if (ImGui::Button("Open...")) context.commands.push_back(commands.ask_to_open);
  tooltip("Open a photo or a run (Ctrl+O)");
  draw_recent(context, recent, commands);
  const float buttons = button_width("?") + gap + button_width(kCommands);
  if (session.has_run()) {
    const float room = ImGui::GetContentRegionMax().x - ImGui::GetItemRectMax().x - buttons - 4 * gap;
    draw_directory(session.run().directory().string(), room, buttons + 2 * gap);
  }
  align_right(buttons);
  if (ImGui::Button(kCommands)) context.commands.push_back(commands.show_palette);
  tooltip("All that can be done, by name (Ctrl+K)");
  ImGui::SameLine();
  if (ImGui::Button("?")) context.commands.push_back(commands.ask_for_help);
  tooltip("Mouse, keys and words (?)");
}

}  // namespace

void draw_top_bar(const PanelContext& context, const Rect& rect,
                  const std::vector<std::filesystem::path>& recent, const TopBarCommands& commands) {
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::kWindow);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em, 0.5f * (rect.size.y - ImGui::GetFrameHeight())});
  ImGui::SetNextWindowPos(rect.position);
  ImGui::SetNextWindowSize(rect.size);
  ImGui::Begin("##top", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
  draw_contents(context, recent, commands);
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace patina
