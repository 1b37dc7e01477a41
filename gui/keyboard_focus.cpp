#include "gui/keyboard_focus.h"

#include <imgui.h>
#include <imgui_internal.h>  // where in a panel the keys are, and that it is seen from the first

#include <array>
#include <utility>

namespace patina {
namespace {

// Names of windows, as the panels give them.
constexpr std::array kPanels{"##top", "Photo", "Render", "Draws", "Material", "Chains", "###draw"};

bool inside_a_panel() {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  const ImGuiWindow* window = context.NavWindow;
  return context.OpenPopupStack.Size > 0 || (window != nullptr && window->RootWindow != window) ||
         context.ActiveId != 0;
}

}  // namespace

bool KeyboardFocus::on() const {
  return (ImGui::GetIO().ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) != 0;
}

void KeyboardFocus::go(int panels) {
  constexpr int kCount = static_cast<int>(kPanels.size());
  panel_ = panel_ < 0 && panels < 0 ? kCount - 1 : (panel_ + panels + kCount) % kCount;
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  ImGuiWindow* window = ImGui::FindWindowByName(kPanels[static_cast<std::size_t>(panel_)]);
  if (window == nullptr) return;
  ImGui::FocusWindow(window);
  ImGui::NavInitWindow(window, true);
  ImGui::GetCurrentContext()->NavDisableHighlight = false;
}

void KeyboardFocus::leave() {
  ImGui::GetIO().ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  ImGui::GetCurrentContext()->NavDisableHighlight = true;
  panel_ = -1;
}

bool KeyboardFocus::follow() {
  if (!on()) return false;
  const bool was_inside = std::exchange(inside_, inside_a_panel());
  const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false) && !was_inside;
  if (escape || ImGui::IsMouseClicked(ImGuiMouseButton_Left) || ImGui::IsMouseClicked(ImGuiMouseButton_Right))
    leave();
  return escape;
}

}  // namespace patina
