#pragma once

#include <vector>

#include "gui/action.h"
#include "gui/panels/panel.h"

namespace patina {

/// What keys and mouse do, and what the words mean, in a box over the window.
/// @param open  set to false where the user closes it
void draw_help_sheet(const PanelContext& context, const std::vector<Action>& actions, bool& open);

}  // namespace patina
