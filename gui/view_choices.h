#pragma once

#include "gui/panels/scatter_panel.h"
#include "gui/preview/preview_view.h"
#include "gui/window/layout.h"

namespace patina {

/// What the user chose about how the window looks, whatever is open in it; a value, so that undo can go back
/// to it.
struct ViewChoices {
  PreviewView preview;  ///< but for its lamp, which follows the mouse
  ScatterPanel::Show draws = ScatterPanel::Show::plot;
  bool clipped = false, seen = false;  ///< of the photo
  ColumnShares shares;
  float scale = 1;
  bool light_theme = false;
  bool operator==(const ViewChoices&) const = default;
};

}  // namespace patina
