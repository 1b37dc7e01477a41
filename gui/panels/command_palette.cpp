#include "gui/panels/command_palette.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "gui/fuzzy.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr const char* kPalette = "Commands##palette";

}  // namespace

void CommandPalette::open() {
  visible_ = focus_ = true;
  typed_.clear();
  choice_ = 0;
}

std::vector<const Action*> CommandPalette::matches(const std::vector<Action>& actions) const {
  std::vector<std::pair<int, const Action*>> scored;
  for (const Action& action : actions) {
    if (!action.enabled()) continue;
    if (const auto score = fuzzy_score(typed_, action.name + " " + action.group))
      scored.emplace_back(*score, &action);
  }
  std::ranges::stable_sort(scored, std::ranges::greater(), [](const auto& each) { return each.first; });
  std::vector<const Action*> found;
  for (const auto& [score, action] : scored) found.push_back(action);
  return found;
}

void CommandPalette::move_choice(std::size_t count) {
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), true); };
  if (count == 0) return;
  if (pressed(ImGuiKey_DownArrow)) choice_ = (choice_ + 1) % count;
  if (pressed(ImGuiKey_UpArrow)) choice_ = (choice_ + count - 1) % count;
  choice_ = std::min(choice_, count - 1);
}

void CommandPalette::choose(const PanelContext& context, const Action& action) {
  context.commands.push_back(action.run);
  close();
}

void CommandPalette::draw(const PanelContext& context, const std::vector<Action>& actions) {
  if (visible_ && !ImGui::IsPopupOpen(kPalette)) ImGui::OpenPopup(kPalette);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({0.5f * display.x, 0.12f * display.y}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({std::min(36 * em, display.x - 2 * em), std::min(30 * em, 0.8f * display.y)});
  if (!ImGui::BeginPopupModal(
          kPalette, nullptr,
          ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
    return;
  if (std::exchange(focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const std::string before = typed_;
  const bool entered = ImGui::InputTextWithHint("##typed", "What would you like to do?", &typed_,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  if (typed_ != before) choice_ = 0;
  const std::vector<const Action*> found = matches(actions);
  move_choice(found.size());
  ImGui::BeginChild("matches");
  for (std::size_t i = 0; i < found.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(found[i]->name.c_str(), i == choice_)) choose(context, *found[i]);
    if (i == choice_ && typed_ == before) ImGui::SetScrollHereY(0.5f);
    const std::string keys = shortcut_text(*found[i]);
    align_right(ImGui::CalcTextSize(keys.c_str()).x + 0.5f * em);
    ImGui::TextDisabled("%s", keys.c_str());
    ImGui::PopID();
  }
  if (found.empty()) muted_text("Nothing of that name.");
  ImGui::EndChild();
  if (entered && !found.empty()) choose(context, *found[choice_]);
  if (!visible_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace patina
