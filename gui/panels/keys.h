#pragma once

#include <imgui.h>

namespace patina {

// Keys that something on the screen takes while it has them.

/// Whether a list, a dialog or a field has the keys.
bool keys_are_elsewhere();

/// Where the arrow keys that are pressed, or held, in this frame point: right and down.
ImVec2 pressed_arrows();

bool enter_pressed();

}  // namespace patina
