#pragma once

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "gui/gl/functions.h"

namespace patina {

/// Of a Framebuffer, whose row 0 is at the top.
struct PixelRect {
  GLint left = 0, top = 0;
  GLsizei width = 0, height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
  bool operator==(const PixelRect&) const = default;
};

inline PixelRect common_part(const PixelRect& a, const PixelRect& b) {
  const GLint left = std::max(a.left, b.left), top = std::max(a.top, b.top);
  return {left, top, std::min(a.left + a.width, b.left + b.width) - left,
          std::min(a.top + a.height, b.top + b.height) - top};
}

/// The least that holds both.
PixelRect spanned(const PixelRect& a, const PixelRect& b);

PixelRect frame_of(const ImDrawData& data);
PixelRect clip_of(const ImDrawData& data, const ImDrawCmd& command);

/// The pixels whose middles lie inside, which are those that two triangles would cover.
PixelRect pixels_of(const ImDrawData& data, ImVec2 low, ImVec2 high);

/// What each triangle of a list may touch, rounding included: that of the indices from 3 i on is i.
using TriangleRects = std::vector<PixelRect>;

std::vector<TriangleRects> triangles_of(const ImDrawData& data);  ///< of each list

}  // namespace patina
