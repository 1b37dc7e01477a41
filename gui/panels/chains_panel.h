#pragma once

#include "gui/panels/panel.h"

namespace patina {

/// What the run is doing in plain words, how far it is, how well its chains do; pause, resume, stop.
/// @param show_costs  what the button that asks what draws cost does, as a command
void draw_chains_panel(const PanelContext& context, const Rect& rect,
                       const std::function<void()>& show_costs);

}  // namespace patina
