#include "gui/gl/imgui_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gui/gl/opaque_fills.h"

namespace patina {
namespace {

// Marks in a draw list, told apart by their address; the renderer acts on them and never calls them.
void premultiplied_mark(const ImDrawList*, const ImDrawCmd*) {}
void straight_mark(const ImDrawList*, const ImDrawCmd*) {}

void blend_straight(const Gl& gl) {
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

template <class T>
std::span<const std::byte> bytes_of(const ImVector<T>& items) {
  return std::as_bytes(std::span<const T>(items.Data, static_cast<std::size_t>(items.Size)));
}

/// Of the framebuffer, whose row 0 is at the bottom.
struct PixelRect {
  GLint left = 0, bottom = 0;
  GLsizei width = 0, height = 0;
};

PixelRect clip_of(const ImDrawData& data, const ImDrawCmd& command) {
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  const ImVec4& clip = command.ClipRect;
  const float left = (clip.x - origin.x) * scale.x, top = (clip.y - origin.y) * scale.y;
  const float right = (clip.z - origin.x) * scale.x, bottom = (clip.w - origin.y) * scale.y;
  return {static_cast<GLint>(left), static_cast<GLint>(data.DisplaySize.y * scale.y - bottom),
          static_cast<GLsizei>(right - left), static_cast<GLsizei>(bottom - top)};
}

/// The pixels whose middles lie inside, which are those that two triangles would cover.
PixelRect pixels_of(const ImDrawData& data, ImVec2 low, ImVec2 high) {
  const ImVec2 scale = data.FramebufferScale, origin = data.DisplayPos;
  const auto edge = [](float at) { return static_cast<int>(std::ceil(at - 0.5f)); };
  const int left = edge((low.x - origin.x) * scale.x), right = edge((high.x - origin.x) * scale.x);
  const int top = edge((low.y - origin.y) * scale.y), bottom = edge((high.y - origin.y) * scale.y);
  return {left, static_cast<int>(data.DisplaySize.y * scale.y) - bottom, right - left, bottom - top};
}

PixelRect common_part(const PixelRect& a, const PixelRect& b) {
  const GLint left = std::max(a.left, b.left), bottom = std::max(a.bottom, b.bottom);
  return {left, bottom, std::min(a.left + a.width, b.left + b.width) - left,
          std::min(a.bottom + a.height, b.bottom + b.height) - bottom};
}

void clear(const Gl& gl, const PixelRect& rect, ImU32 color) {
  if (rect.width <= 0 || rect.height <= 0) return;
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
  gl.Scissor(rect.left, rect.bottom, rect.width, rect.height);
  gl.ClearColor(c.x, c.y, c.z, c.w);
  gl.Clear(GL_COLOR_BUFFER_BIT);
}

}  // namespace

ImguiRenderer::ImguiRenderer(const Gl& gl)
    : gl_(gl),
      program_(Program::load(gl, "imgui", "imgui")),
      layout_(gl),
      vertices_(gl, GL_ARRAY_BUFFER),
      indices_(gl, GL_ELEMENT_ARRAY_BUFFER) {
  vertices_.bind();
  layout_.attribute(0, 2, GL_FLOAT, false, sizeof(ImDrawVert), offsetof(ImDrawVert, pos));
  layout_.attribute(1, 2, GL_FLOAT, false, sizeof(ImDrawVert), offsetof(ImDrawVert, uv));
  layout_.attribute(2, 4, GL_UNSIGNED_BYTE, true, sizeof(ImDrawVert), offsetof(ImDrawVert, col));
  ImGuiIO& io = ImGui::GetIO();
  io.BackendRendererName = "patina";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
}

void ImguiRenderer::prepare() {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (fonts_ && atlas.IsBuilt()) return;
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  atlas.GetTexDataAsRGBA32(&pixels, &width, &height);
  const std::size_t size = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  fonts_ = Texture::rgba8(gl_, width, height, {pixels, size}, TextureFilter::nearest);
  atlas.SetTexID(fonts_->imgui_id());
}

void ImguiRenderer::begin(const ImDrawData& data) const {
  gl_.Viewport(0, 0, static_cast<GLsizei>(data.DisplaySize.x * data.FramebufferScale.x),
               static_cast<GLsizei>(data.DisplaySize.y * data.FramebufferScale.y));
  gl_.Enable(GL_BLEND);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.BlendEquation(GL_FUNC_ADD);
  blend_straight(gl_);
  program_.use();
  gl_.Uniform1i(program_.location("image"), 0);
  gl_.Uniform2f(program_.location("origin"), data.DisplayPos.x, data.DisplayPos.y);
  gl_.Uniform2f(program_.location("extent"), data.DisplaySize.x, data.DisplaySize.y);
  layout_.bind();
}

void ImguiRenderer::draw(const ImDrawData& data, const ImDrawList& list, const ImDrawCmd& command) const {
  constexpr float kLargeFill = 2000;  // pixels that are worth a draw call more
  const PixelRect clip = clip_of(data, command);
  if (clip.width <= 0 || clip.height <= 0) return;
  const auto draw_indices = [&](unsigned from, unsigned to) {
    if (from == to) return;
    gl_.Scissor(clip.left, clip.bottom, clip.width, clip.height);
    gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(to - from), GL_UNSIGNED_SHORT,
                               reinterpret_cast<const void*>(from * sizeof(ImDrawIdx)),
                               static_cast<GLint>(command.VtxOffset));
  };
  gl_.BindTexture(GL_TEXTURE_2D, static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
  const bool has_fills = command.GetTexID() == ImGui::GetIO().Fonts->TexID;
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  const unsigned end = command.IdxOffset + command.ElemCount;
  unsigned drawn = command.IdxOffset;
  for (unsigned i = drawn; has_fills && i + 6 <= end; i += 3) {
    const auto fill = opaque_fill(list, command, i, white);
    if (!fill || fill->area() < kLargeFill) continue;
    draw_indices(drawn, i);
    clear(gl_, common_part(pixels_of(data, fill->low, fill->high), clip), fill->color);
    drawn = i + 6;
    i += 3;
  }
  draw_indices(drawn, end);
}

void ImguiRenderer::render(const ImDrawData& data) {
  static_assert(sizeof(ImDrawIdx) == 2, "draw() says GL_UNSIGNED_SHORT");
  if (data.DisplaySize.x <= 0 || data.DisplaySize.y <= 0) return;
  begin(data);
  gl_.ActiveTexture(GL_TEXTURE0);
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    vertices_.assign(bytes_of(list.VtxBuffer));
    indices_.assign(bytes_of(list.IdxBuffer));
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (!command.UserCallback) {
        draw(data, list, command);
      } else if (command.UserCallback == premultiplied_mark) {
        gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      } else if (command.UserCallback == straight_mark) {
        blend_straight(gl_);
      } else if (command.UserCallback == ImDrawCallback_ResetRenderState) {
        begin(data);
      } else {
        command.UserCallback(&list, &command);
      }
    }
  }
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
}

void add_premultiplied_image(ImDrawList& list, ImTextureID texture, ImVec2 top_left, ImVec2 bottom_right) {
  list.AddCallback(premultiplied_mark, nullptr);
  list.AddImage(texture, top_left, bottom_right);
  list.AddCallback(straight_mark, nullptr);
}

}  // namespace patina
