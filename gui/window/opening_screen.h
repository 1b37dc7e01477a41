#pragma once

#include <string>

#include "gui/window/fonts.h"
#include "gui/window/preferences.h"
#include "gui/window/window.h"

namespace patina {

/// What the window shows until the explorer is there: its panels, still empty.
class OpeningScreen {
 public:
  /// @param window  outlives it  @param input  what will be opened, as the user named it; may be empty
  OpeningScreen(Window& window, const Preferences& preferences, std::string input);

  /// Draws one frame. Files that are dropped meanwhile wait in the window.
  void frame();

 private:
  Window& window_;
  ColumnShares shares_;
  std::string input_;
  Fonts fonts_;
};

}  // namespace patina
