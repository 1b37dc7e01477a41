#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/window/desktop.h"

// What someone in front of the screen waits for and finds there.
namespace patina {

inline constexpr std::uint32_t kAccent = 0x58b8a0;  // of the button that says what to do next (gui/theme.h)

/// Waits up to two minutes: machines are slow. Returns whether it came true.
inline bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 1200; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(100)))
    if (condition()) return true;
  return false;
}

/// patina of this build: it lies beside the test.
inline std::filesystem::path program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "patina";
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
  comes_true([&] {
    Desktop::Picture next = desktop.picture(window);
    still = next.pixels == picture.pixels ? still + 1 : 0;
    picture = std::move(next);
    return still == 20;
  });
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
