#pragma once

#include <functional>
#include <string>

#include "gui/panels/panel.h"
#include "gui/shown_draw.h"

namespace patina {

/// Which draw is shown and how good it is; walking along the draws by lp; export.
class DrawPanel {
 public:
  /// @param export_note    how the last export ended, or that one is under way; may be empty
  /// @param ask_to_export  carried out as a command where the user asks for it
  void draw(const PanelContext& context, const Rect& rect, const ShownDraw& shown,
            const std::string& export_note, const std::function<void()>& ask_to_export);

  int export_resolution() const { return export_resolution_; }  ///< pixels a side of the maps

 private:
  void draw_export(const PanelContext& context, const std::function<void()>& ask_to_export);

  int export_resolution_ = 1024;
};

}  // namespace patina
