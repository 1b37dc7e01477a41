#pragma once

#include "gui/fonts.h"
#include "gui/preferences.h"
#include "gui/window.h"

namespace patina {

/// Gives the window's ImGui the fonts, colours and spacing that the preferences ask for on its screen.
Fonts dress(const Window& window, const Preferences& preferences);

}  // namespace patina
