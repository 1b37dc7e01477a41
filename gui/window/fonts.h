#pragma once

#include <imgui.h>

namespace patina {

/// The program's two weights of type. Owned by ImGui's atlas.
struct Fonts {
  ImFont* regular;
  ImFont* semibold;
};

/// Fills the current ImGui context's atlas: Inter, else DejaVu Sans, else Dear ImGui's built-in font;
/// Latin-1, Greek, punctuation, and the symbols the panels use. Regular becomes the default font.
/// @param size           ImGui units
/// @param pixel_density  framebuffer pixels per unit (Window::pixel_density())
Fonts load_fonts(float size, float pixel_density);

}  // namespace patina
