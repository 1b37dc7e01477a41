#pragma once

#include <imgui.h>

#include "gui/gl/functions.h"

namespace patina {

/// Of a Framebuffer, whose row 0 is at the top.
struct PixelRect {
  GLint left = 0, top = 0;
  GLsizei width = 0, height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
  bool operator==(const PixelRect&) const = default;
};

PixelRect common_part(const PixelRect& a, const PixelRect& b);

/// The least that holds both.
PixelRect spanned(const PixelRect& a, const PixelRect& b);

PixelRect frame_of(const ImDrawData& data);
PixelRect clip_of(const ImDrawData& data, const ImDrawCmd& command);

/// The pixels whose middles lie inside, which are those that two triangles would cover.
PixelRect pixels_of(const ImDrawData& data, ImVec2 low, ImVec2 high);

/// Those that the triangle of three of a command's indices may touch, rounding included.
PixelRect pixels_near(const ImDrawData& data, const ImDrawList& list, const ImDrawCmd& command,
                      const ImDrawIdx* indices);

}  // namespace patina
