#include "gui/gl/pixel_rect.h"

#include <algorithm>
#include <cmath>

namespace patina {

PixelRect common_part(const PixelRect& a, const PixelRect& b) {
  const GLint left = std::max(a.left, b.left), top = std::max(a.top, b.top);
  return {left, top, std::min(a.left + a.width, b.left + b.width) - left,
          std::min(a.top + a.height, b.top + b.height) - top};
}

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

PixelRect pixels_near(const ImDrawData& data, const ImDrawList& list, const ImDrawCmd& command,
                      const ImDrawIdx* indices) {
  const auto place = [&](int k) {
    return list.VtxBuffer[static_cast<int>(command.VtxOffset + indices[k])].pos;
  };
  const ImVec2 a = place(0), b = place(1), c = place(2);
  const PixelRect inside = pixels_of(data, {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})},
                                     {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})});
  return {inside.left - 1, inside.top - 1, inside.width + 2, inside.height + 2};
}

}  // namespace patina
