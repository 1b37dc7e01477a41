#pragma once

#include <functional>
#include <string>

#include "gui/panels/panel.h"
#include "gui/shown_draw.h"

namespace patina {

/// Which draw is shown and how good it is; walking along the draws by lp; export.
/// @param export_note    how the last export ended, or that one is under way; may be empty
/// @param ask_to_export  carried out as a command where the user asks for it
void draw_draw_panel(const PanelContext& context, const Rect& rect, const ShownDraw& shown,
                     const std::string& export_note, const std::function<void()>& ask_to_export);

}  // namespace patina
