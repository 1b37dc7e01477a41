#pragma once

#include <functional>
#include <optional>
#include <string>

#include "gui/panels/panel.h"
#include "gui/preview/shown_draw.h"

namespace patina {

/// How exporting stands.
struct ExportNews {
  std::optional<double> done;  ///< of the export under way, 0 to 1; none: none is
  std::string note;            ///< how the last one ended; may be empty
};

/// Which draw is shown and how good it is; walking along the draws by lp; export.
/// @param ask_to_export, cancel_export  carried out as commands where the user asks for it
void draw_draw_panel(const PanelContext& context, const Rect& rect, const ShownDraw& shown,
                     const ExportNews& news, const std::function<void()>& ask_to_export,
                     const std::function<void()>& cancel_export);

}  // namespace patina
