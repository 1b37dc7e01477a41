#pragma once

#include "gui/panels/panel.h"

namespace patina {

/// A button, and the list that it opens: when the next run ends by itself.
void draw_stop_rules(const PanelContext& context);

/// The button's width.
float stop_rules_width();

}  // namespace patina
