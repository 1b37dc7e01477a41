#include "gui/gl/pixel_rect.h"

#include <algorithm>
#include <cmath>

namespace patina {

PixelRect spanned(const PixelRect& a, const PixelRect& b) {
  const GLint left = std::min(a.left, b.left), top = std::min(a.top, b.top);
  return {left, top, std::max(a.left + a.width, b.left + b.width) - left,
          std::max(a.top + a.height, b.top + b.height) - top};
}

PixelRect frame_of(const ImDrawData& data) {
  return {0, 0, static_cast<GLsizei>(data.DisplaySize.x * data.FramebufferScale.x),
          static_cast<GLsizei>(data.DisplaySize.y * data.FramebufferScale.y)};
}

PixelRect clip_of(const ImDrawData& data, const ImDrawCmd& command) {
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  const ImVec4& clip = command.ClipRect;
  const auto left = static_cast<GLint>((clip.x - origin.x) * scale.x);
  const auto top = static_cast<GLint>((clip.y - origin.y) * scale.y);
  return {left, top, static_cast<GLint>((clip.z - origin.x) * scale.x) - left,
          static_cast<GLint>((clip.w - origin.y) * scale.y) - top};
}

PixelRect pixels_of(const ImDrawData& data, ImVec2 low, ImVec2 high) {
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  const auto edge = [](float at) { return static_cast<int>(std::ceil(at - 0.5f)); };
  const int left = edge((low.x - origin.x) * scale.x), right = edge((high.x - origin.x) * scale.x);
  const int top = edge((low.y - origin.y) * scale.y), bottom = edge((high.y - origin.y) * scale.y);
  return {left, top, right - left, bottom - top};
}

namespace {

TriangleRects triangles_of(const ImDrawData& data, const ImDrawList& list) {
  constexpr int kMargin = 2;  // of rounding, and of casts, which round towards 0
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  const auto pixel = [](float at) {
    constexpr float kFar = 1e6f;  // pixels; what lies beyond is on no screen
    return static_cast<int>(std::clamp(at, -kFar, kFar));
  };
  TriangleRects rects(static_cast<std::size_t>(list.IdxBuffer.Size / 3));
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
    for (unsigned i = command.IdxOffset; i + 3 <= command.IdxOffset + command.ElemCount; i += 3) {
      const ImDrawIdx* index = list.IdxBuffer.Data + i;
      const ImVec2 a = vertices[index[0]].pos, b = vertices[index[1]].pos, c = vertices[index[2]].pos;
      const int left = pixel((std::min({a.x, b.x, c.x}) - origin.x) * scale.x) - kMargin;
      const int right = pixel((std::max({a.x, b.x, c.x}) - origin.x) * scale.x) + kMargin;
      const int top = pixel((std::min({a.y, b.y, c.y}) - origin.y) * scale.y) - kMargin;
      const int bottom = pixel((std::max({a.y, b.y, c.y}) - origin.y) * scale.y) + kMargin;
      rects[i / 3] = {left, top, right - left, bottom - top};
    }
  }
  return rects;
}

}  // namespace

std::vector<TriangleRects> triangles_of(const ImDrawData& data) {
  std::vector<TriangleRects> all;
  for (int n = 0; n < data.CmdListsCount; ++n) all.push_back(triangles_of(data, *data.CmdLists[n]));
  return all;
}

}  // namespace patina
