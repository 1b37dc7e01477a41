#pragma once

#include <imgui.h>

#include "engine/image.h"
#include "gui/gl/imgui_renderer.h"

namespace patina {

/// A Dear ImGui context for as long as it lives, current from the start.
class ImguiContext {
 public:
  ImguiContext();
  ~ImguiContext();
  ImguiContext(const ImguiContext&) = delete;
  ImguiContext& operator=(const ImguiContext&) = delete;
};

/// Ends ImGui's frame and draws it into the window's own framebuffer.
void draw_frame(ImguiRenderer& renderer);

/// Shows the last frame once more (a window's pixels are undefined after a swap) and reads it back: 3
/// channels in [0,1], rows from the top.
Image read_frame(const Gl& gl, ImguiRenderer& renderer);

}  // namespace patina
