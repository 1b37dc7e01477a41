#pragma once

#include "gui/panels/panel.h"

namespace patina {

/// What the mouse and the keys do, and what the words mean, in a box over the window.
/// @param open  set to false where the user closes it
void draw_help_sheet(const PanelContext& context, bool& open);

}  // namespace patina
