#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {

/// What a person at a display sees and does. Window ids are X11's.
class Desktop {
 public:
  using Window = unsigned long;

  /// The window's pixels, row by row from the top, as 0xRRGGBB.
  struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;
  };

  /// @throws std::runtime_error if there is no such display
  explicit Desktop(const std::string& display);
  ~Desktop();

  /// The first window that has a title.
  std::optional<Window> window() const;
  std::string title(Window window) const;
  Picture picture(Window window) const;

  void click(int x, int y) const;            ///< the left button, in pixels of the screen
  void press(const std::string& key) const;  ///< as xdotool names it: "space", "ctrl+o"
  void type(const std::string& text) const;

  /// Drags a file from another program onto the middle of a window and lets it fall there (XDND version 5).
  /// @return whether the window took it
  bool drop(Window window, const std::filesystem::path& file) const;

  void close(Window window) const;  ///< as the cross in the title bar does

 private:
  struct Connection;
  std::string display_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace patina
