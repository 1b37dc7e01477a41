#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "gui/panels/panel.h"
#include "gui/shown_draw.h"

namespace patina {

/// What the draw panel can ask for.
struct DrawPanelActions {
  std::function<void()> export_draw;  ///< asks for a folder
};

/// Which draw is shown and how good it is; walking along the draws by lp; export.
/// @param export_note  how the last export ended, or that one is under way; may be empty
void draw_draw_panel(const PanelContext& context, const Rect& rect, const ShownDraw& shown,
                     const std::string& export_note, const DrawPanelActions& actions);

}  // namespace patina
