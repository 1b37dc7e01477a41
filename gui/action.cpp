#include "gui/action.h"

namespace patina {
namespace {

constexpr int kBeforeF1 = 289;  // GLFW's code of F1, less 1; Dear ImGui 1.86 has no names for these keys

ImGuiKeyModFlags held_modifiers() {
  const ImGuiIO& io = ImGui::GetIO();
  return (io.KeyCtrl ? ImGuiKeyModFlags_Ctrl : 0) | (io.KeyShift ? ImGuiKeyModFlags_Shift : 0) |
         (io.KeyAlt ? ImGuiKeyModFlags_Alt : 0) | (io.KeySuper ? ImGuiKeyModFlags_Super : 0);
}

}  // namespace

Shortcut Shortcut::letter(char key, ImGuiKeyModFlags modifiers) {
  Shortcut shortcut;
  shortcut.key = key;
  shortcut.modifiers = modifiers;
  return shortcut;
}

Shortcut Shortcut::named(ImGuiKey key, const char* name, ImGuiKeyModFlags modifiers) {
  Shortcut shortcut;
  shortcut.named_key = key;
  shortcut.name = name;
  shortcut.modifiers = modifiers;
  return shortcut;
}

Shortcut Shortcut::character(char character) {
  Shortcut shortcut;
  shortcut.typed = character;
  return shortcut;
}

Shortcut Shortcut::function(int number, ImGuiKeyModFlags modifiers) {
  static constexpr const char* kNames[] = {"F1", "F2", "F3", "F4",  "F5",  "F6",
                                           "F7", "F8", "F9", "F10", "F11", "F12"};
  Shortcut shortcut;
  shortcut.key = kBeforeF1 + number;
  shortcut.name = kNames[number - 1];
  shortcut.modifiers = modifiers;
  return shortcut;
}

bool Shortcut::pressed(bool repeats) const {
  if (typed != 0) return ImGui::GetIO().InputQueueCharacters.contains(static_cast<ImWchar>(typed));
  if (held_modifiers() != modifiers) return false;
  return ImGui::IsKeyPressed(key != 0 ? key : ImGui::GetKeyIndex(named_key), repeats);
}

std::string Shortcut::text() const {
  std::string text;
  if ((modifiers & ImGuiKeyModFlags_Ctrl) != 0) text += "Ctrl+";
  if ((modifiers & ImGuiKeyModFlags_Shift) != 0) text += "Shift+";
  if ((modifiers & ImGuiKeyModFlags_Alt) != 0) text += "Alt+";
  if (typed != 0) return text + typed;
  if (key == '=') return text + "Plus";  // where most keyboards have it
  if (key == '-') return text + "Minus";
  return *name == 0 ? text + static_cast<char>(key) : text + name;
}

std::string shortcut_text(const Action& action) {
  std::string text;
  for (const Shortcut& shortcut : action.shortcuts) text += (text.empty() ? "" : ", ") + shortcut.text();
  return text;
}

}  // namespace patina
