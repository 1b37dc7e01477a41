#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <ostream>

#include "gui/window/offscreen_window.h"

namespace patina {

/// A pixel in bytes, as exact comparisons want it.
struct Rgb {
  int red = 0, green = 0, blue = 0;
  bool operator==(const Rgb&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Rgb& c) {
  return out << "(" << c.red << ", " << c.green << ", " << c.blue << ")";
}

inline Rgb pixel(const Image& image, int row, int column) {
  const auto byte = [&](int channel) {
    return static_cast<int>(std::lround(255 * image.at(row, column, channel)));
  };
  return {byte(0), byte(1), byte(2)};
}

/// Tests that draw: a small window in memory, and its GL.
class GlTest : public ::testing::Test {
 protected:
  const Gl& gl() const { return window->gl(); }

  /// One frame of what `lay_out` draws behind everything, as a picture.
  template <class LayOut>
  Image frame(LayOut lay_out) {
    window->begin_frame(0);
    lay_out(*ImGui::GetBackgroundDrawList());
    window->end_frame();
    return window->screenshot();
  }

  std::unique_ptr<OffscreenWindow> window = OffscreenWindow::make(64, 48);
};

}  // namespace patina
