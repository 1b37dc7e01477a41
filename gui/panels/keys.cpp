#include "gui/panels/keys.h"

namespace patina {
namespace {

bool pressed(ImGuiKey key, bool repeats) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeats); }

float towards(ImGuiKey forward, ImGuiKey back) {
  return static_cast<float>(pressed(forward, true)) - static_cast<float>(pressed(back, true));
}

}  // namespace

bool keys_are_elsewhere() {
  return ImGui::GetIO().WantTextInput ||
         ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

ImVec2 pressed_arrows() {
  return {towards(ImGuiKey_RightArrow, ImGuiKey_LeftArrow), towards(ImGuiKey_DownArrow, ImGuiKey_UpArrow)};
}

bool enter_pressed() { return pressed(ImGuiKey_Enter, false) || pressed(ImGuiKey_KeyPadEnter, false); }

}  // namespace patina
