#include "gui/gl/imgui_renderer.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

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
  fonts_ = Texture::rgba8(gl_, width, height, {pixels, size}, TextureFilter::linear);
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

void ImguiRenderer::draw(const ImDrawData& data, const ImDrawCmd& command) const {
  const auto scaled = [&](float x, float y) {
    return ImVec2((x - data.DisplayPos.x) * data.FramebufferScale.x,
                  (y - data.DisplayPos.y) * data.FramebufferScale.y);
  };
  const ImVec2 low = scaled(command.ClipRect.x, command.ClipRect.y);
  const ImVec2 high = scaled(command.ClipRect.z, command.ClipRect.w);
  if (high.x <= low.x || high.y <= low.y) return;
  const float framebuffer_height = data.DisplaySize.y * data.FramebufferScale.y;
  gl_.Scissor(static_cast<GLint>(low.x), static_cast<GLint>(framebuffer_height - high.y),
              static_cast<GLsizei>(high.x - low.x), static_cast<GLsizei>(high.y - low.y));
  gl_.BindTexture(GL_TEXTURE_2D, static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
  gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), GL_UNSIGNED_SHORT,
                             reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                             static_cast<GLint>(command.VtxOffset));
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
        draw(data, command);
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
