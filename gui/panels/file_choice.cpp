#include "gui/panels/file_choice.h"

#include <algorithm>
#include <utility>

#include "gui/window/theme.h"

namespace patina {

void FileChoice::ask(std::vector<std::filesystem::path> files) { files_ = std::move(files); }

std::optional<std::filesystem::path> FileChoice::draw(const PanelContext& context) {
  constexpr const char* kName = "Which one?##files";
  if (visible() && !ImGui::IsPopupOpen(kName)) ImGui::OpenPopup(kName);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  const float width = std::min(34 * em, display.x - 2 * em);
  ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, display.y - 2 * em});
  if (!ImGui::BeginPopupModal(kName, nullptr,
                              ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize))
    return std::nullopt;
  heading_text(context, "Which one?");
  muted_text("A run is about one photo; choose the one to open.");
  std::optional<std::filesystem::path> chosen;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (i == 0 && ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    if (ImGui::Selectable(files_[i].filename().string().c_str())) chosen = files_[i];
    tooltip(files_[i].string());
    ImGui::PopID();
  }
  if (ImGui::Button("Cancel") || chosen) close();
  if (!visible()) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return chosen;
}

}  // namespace patina
