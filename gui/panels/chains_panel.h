#pragma once

#include "gui/panels/panel.h"

namespace patina {

/// What the run is doing in plain words, how far it is, how well its chains do; pause, resume, stop.
void draw_chains_panel(const PanelContext& context, const Rect& rect);

}  // namespace patina
