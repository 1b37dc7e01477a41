#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "gui/panels/panel.h"

namespace patina {

/// What the top bar's buttons do, carried out as commands.
struct TopBarCommands {
  std::function<void()> ask_to_open;
  std::function<void(const std::filesystem::path&)> open;
  std::function<void()> ask_for_help;
  std::function<void()> show_palette;
};

/// The program's name, what to open, where the run is kept, commands and help.
/// @param recent  what was opened before, newest first
void draw_top_bar(const PanelContext& context, const Rect& rect,
                  const std::vector<std::filesystem::path>& recent, const TopBarCommands& commands);

}  // namespace patina
