#include "gui/panels/error_banner.h"

#include <algorithm>

#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr std::size_t kMost = 3;  // sentences at once

}  // namespace

void ErrorBanner::show(Kind kind, std::string sentence) {
  std::erase_if(messages_, [&](const Message& message) { return message.sentence == sentence; });
  if (messages_.size() == kMost) messages_.erase(messages_.begin());
  messages_.push_back({kind, std::move(sentence)});
}

void ErrorBanner::draw(const PanelContext& context, ImVec2 window_size) {
  if (messages_.empty()) return;
  const float em = ImGui::GetFontSize();
  const float width = std::min(52 * em, window_size.x - 2 * em);
  ImGui::SetNextWindowPos({0.5f * window_size.x, window_size.y - em}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme::kBanner);
  ImGui::Begin("##banner", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
  const float button = button_width("Dismiss");
  const float wrap = ImGui::GetContentRegionAvail().x - button - em;
  ImGui::BeginGroup();
  for (const Message& message : messages_) {
    ImGui::PushStyleColor(ImGuiCol_Text, message.kind == Kind::error ? theme::kError : theme::kWarning);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(message.sentence.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
  }
  ImGui::EndGroup();
  align_right(button);
  if (ImGui::Button("Dismiss")) context.commands.push_back([this] { dismiss(); });
  tooltip("Esc");
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace patina
