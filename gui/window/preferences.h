#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "gui/draw_place.h"
#include "gui/window/layout.h"

namespace patina {

/// What the program remembers from one start to the next.
struct Preferences {
  static constexpr std::size_t kMostRecent = 10;
  static constexpr float kLeastScale = 0.6f, kMostScale = 3;

  std::vector<std::filesystem::path> recent;  ///< photos and runs, the newest first
  std::filesystem::path last_folder;          ///< of the file dialog
  std::filesystem::path last_run;             ///< that was open; empty: none
  std::optional<DrawPlace> draw;              ///< that was selected in it
  int width = 1280, height = 800;             ///< of the window
  ColumnShares shares;
  float scale = 1;  ///< of text and spacing, beside the screen's own
  bool light_theme = false;

  /// Puts a file in front of the recent ones.
  void opened(const std::filesystem::path& file);

  bool operator==(const Preferences&) const = default;
};

/// $XDG_CONFIG_HOME/patina/settings.json, or below ~/.config; empty if there is neither.
std::filesystem::path preferences_file();

/// The preferences in a file; what is missing or out of range is as at first. No file: all is.
/// @throws UserError (a sentence) for a file that is not such JSON
Preferences read_preferences(const std::filesystem::path& file);

/// Atomically, into a folder that is made if need be. @throws UserError
void write_preferences(const std::filesystem::path& file, const Preferences& preferences);

}  // namespace patina
