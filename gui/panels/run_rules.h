#pragma once

#include "gui/panels/panel.h"

namespace patina {

/// A button, and what it opens: when the next run ends by itself, and what it takes renders to be off by.
void draw_run_rules(const PanelContext& context);

/// The button's width.
float run_rules_width();

}  // namespace patina
