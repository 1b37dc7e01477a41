#pragma once

#include <imgui.h>

#include <cstdint>
#include <vector>

#include "gui/gl/pixel_rect.h"

namespace patina {

/// Tells where a frame of Dear ImGui differs from the one before. Of each tile of the screen it keeps a hash
/// of all that is drawn there, in order; a texture with other contents has another ImTextureID (see
/// Texture::imgui_id()). A software rasteriser is spared what stays as it is, most of a window.
class FrameChanges {
 public:
  /// Disjoint rectangles outside of which the frame is as the one was that was asked about last.
  /// @param triangles  triangles_of(data)
  std::vector<PixelRect> follow(const ImDrawData& data, const std::vector<TriangleRects>& triangles);

 private:
  PixelRect frame_;
  std::vector<std::uint64_t> tiles_;  ///< rows from the top
};

}  // namespace patina
