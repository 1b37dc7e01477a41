#pragma once

#include <functional>

#include "gui/panels/panel.h"

namespace patina {

/// The program's name, what to open, where the run is kept, help.
void draw_top_bar(const PanelContext& context, const Rect& rect, const std::function<void()>& ask_to_open,
                  const std::function<void()>& ask_for_help);

}  // namespace patina
