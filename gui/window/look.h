#pragma once

#include "gui/window/fonts.h"
#include "gui/window/preferences.h"
#include "gui/window/window.h"

namespace patina {

/// Gives the window's ImGui the fonts, colours and spacing that the preferences ask for on its screen.
Fonts dress(const Window& window, const Preferences& preferences);

}  // namespace patina
