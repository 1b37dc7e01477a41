#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/comes_true.h"
#include "tests/support/program.h"
#include "tests/window/desktop.h"

// What someone in front of the screen waits for and finds there.
namespace patina {

/// Of the button that says what to do next (gui/window/theme.h).
inline constexpr std::uint32_t kAccent = 0x58b8a0;

/// Starts the patina of this build, which lies beside the test, as a new user's.
inline Program start_patina(const std::string& display, const std::filesystem::path& home) {
  const auto patina = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "patina";
  return Program({patina.string(), "--size", "1280x800"},
                 {.environment = {{"DISPLAY", display},
                                  {"HOME", home.string()},
                                  {"XDG_DATA_HOME", home.string()},
                                  {"XDG_CONFIG_HOME", home.string()}},
                  .inherited = -1,
                  .out = {},
                  .err = {}});
}

/// Share of pixels that differ.
inline double difference(const Desktop::Picture& a, const Desktop::Picture& b) {
  if (a.pixels.size() != b.pixels.size()) return 1;
  double differing = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) differing += a.pixels[i] != b.pixels[i];
  return differing / static_cast<double>(a.pixels.size());
}

/// The window once nothing in it has changed for two seconds.
inline Desktop::Picture settled(const Desktop& desktop, Desktop::Window window) {
  Desktop::Picture picture = desktop.picture(window);
  int still = 0;
  const auto looks_the_same = [&] {
    Desktop::Picture next = desktop.picture(window);
    still = next.pixels == picture.pixels ? still + 1 : 0;
    picture = std::move(next);
    return still == 20;
  };
  comes_true(looks_the_same, std::chrono::milliseconds(100));
  return picture;
}

struct Place {
  int x = 0, y = 0;
};

/// The middle of the first row of at least 60 pixels of a colour.
inline std::optional<Place> find_bar(const Desktop::Picture& picture, std::uint32_t colour) {
  for (int y = 0; y < picture.height; ++y) {
    int length = 0;
    for (int x = 0; x < picture.width; ++x) {
      const bool same = picture.pixels[static_cast<std::size_t>(y) * picture.width + x] == colour;
      if (!same && length >= 60) return Place{x - length / 2, y};
      length = same ? length + 1 : 0;
    }
  }
  return std::nullopt;
}

/// The directories of the runs in a folder.
inline std::vector<std::filesystem::path> runs_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> runs;
  if (!std::filesystem::is_directory(folder)) return runs;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::filesystem::exists(entry.path() / "run.json")) runs.push_back(entry.path());
  return runs;
}

}  // namespace patina
