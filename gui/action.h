#pragma once

#include <imgui.h>

#include <functional>
#include <string>
#include <vector>

namespace patina {

/// What a user presses: a key with its modifiers, or a character however the keyboard makes it.
struct Shortcut {
  /// A capital letter, digit or punctuation key. @param key  its ASCII code
  static Shortcut letter(char key, ImGuiKeyModFlags modifiers = ImGuiKeyModFlags_None);
  static Shortcut named(ImGuiKey key, const char* name, ImGuiKeyModFlags modifiers = ImGuiKeyModFlags_None);
  static Shortcut character(char character);
  static Shortcut function(int number, ImGuiKeyModFlags modifiers = ImGuiKeyModFlags_None);  ///< F1 ... F12

  bool pressed(bool repeats) const;  ///< in this frame
  std::string text() const;          ///< "Ctrl+Shift+P"
  /// Whether it moves something while the keys are in a panel (KeyboardFocus), a plot or the photo.
  bool navigates() const { return named_key >= 0; }

  int key = 0;  ///< as letter() takes it; 0: another kind
  ImGuiKey named_key = -1;
  char typed = 0;
  const char* name = "";
  ImGuiKeyModFlags modifiers = ImGuiKeyModFlags_None;
};

/// Something that a user can do by a key or by name. The one list of them feeds keys, palette and help.
struct Action {
  const char* group;  ///< "Preview"
  std::string name;   ///< "Wipe between photo and render"
  std::vector<Shortcut> shortcuts;
  std::function<void()> run;
  std::function<bool()> enabled = [] { return true; };
  bool repeats = false;  ///< while its key is held
};

std::string shortcut_text(const Action& action);  ///< of all its shortcuts; empty without any

}  // namespace patina
