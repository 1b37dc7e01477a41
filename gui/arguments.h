#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace patina {

/// What the command line of `patina` asks for.
struct Arguments {
  std::filesystem::path input;       ///< photo or run directory; empty: the bundled sample
  std::string material;              ///< empty: the default one
  std::filesystem::path offscreen;   ///< picture of the window to save; empty: a real window
  double seconds = 20;               ///< how long to run off screen
  std::optional<int> width, height;  ///< of the window, in screen coordinates; none: as it was left
};

/// @return nothing where the text that was asked for (--help, --version) has been printed
/// @throws UserError for a bad command line
std::optional<Arguments> parse_arguments(int argc, char** argv);

}  // namespace patina
