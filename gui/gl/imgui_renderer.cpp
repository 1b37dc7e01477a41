#include "gui/gl/imgui_renderer.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "gui/gl/opaque_fills.h"

namespace patina {
namespace {

// Marks in a draw list, told apart by their address; the renderer acts on them and never calls them.
void premultiplied_mark(const ImDrawList*, const ImDrawCmd*) {}
void straight_mark(const ImDrawList*, const ImDrawCmd*) {}

void blend_straight(const Gl& gl) {
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void clear(const Gl& gl, const PixelRect& rect, ImU32 color) {
  if (rect.empty()) return;
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
  gl.Scissor(rect.left, rect.top, rect.width, rect.height);
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
  const PixelRect frame = frame_of(data);
  gl_.Viewport(0, 0, frame.width, frame.height);
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

std::vector<ImguiRenderer::Step> ImguiRenderer::steps_of(const ImDrawData& data, const ImDrawList& list,
                                                         const TriangleRects& triangles,
                                                         const PixelRect& part) {
  constexpr float kLargeFill = 2000;  // pixels that are worth a draw call more
  const ImTextureID fonts = ImGui::GetIO().Fonts->TexID;
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  std::vector<Step> steps;
  kept_.clear();
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const PixelRect clip = common_part(clip_of(data, command), part);
    if (command.UserCallback) steps.push_back({&command, clip, kept_.size(), 0, {}});
    if (command.UserCallback || clip.empty()) continue;
    const unsigned end = command.IdxOffset + command.ElemCount;
    std::size_t first = kept_.size();
    const auto end_step = [&] {
      if (kept_.size() > first) steps.push_back({&command, clip, first, kept_.size() - first, {}});
      first = kept_.size();
    };
    for (unsigned i = command.IdxOffset; i + 3 <= end; i += 3) {
      if (common_part(triangles[i / 3], clip).empty()) continue;
      const ImDrawIdx* triangle = list.IdxBuffer.Data + i;
      const bool may_fill = command.GetTexID() == fonts && i + 6 <= end;
      const auto fill = may_fill ? opaque_fill(list, command, i, white) : std::nullopt;
      if (fill && fill->area() >= kLargeFill) {
        end_step();
        steps.push_back(
            {&command, common_part(pixels_of(data, fill->low, fill->high), clip), first, 0, fill->color});
        i += 3;
      } else {
        kept_.insert(kept_.end(), triangle, triangle + 3);
      }
    }
    end_step();
  }
  return steps;
}

void ImguiRenderer::draw(const ImDrawData& data, const std::vector<Step>& steps) {
  indices_.assign(std::as_bytes(std::span(kept_)));
  blend_straight(gl_);
  for (const Step& step : steps) {
    const ImDrawCmd& command = *step.command;
    if (command.UserCallback == premultiplied_mark) {
      gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    } else if (command.UserCallback == straight_mark) {
      blend_straight(gl_);
    } else if (command.UserCallback) {
      assert(command.UserCallback == ImDrawCallback_ResetRenderState);
      begin(data);
    } else if (step.fill) {
      clear(gl_, step.clip, *step.fill);
    } else {
      gl_.BindTexture(GL_TEXTURE_2D, Texture::name_in(command.GetTexID()));
      gl_.Scissor(step.clip.left, step.clip.top, step.clip.width, step.clip.height);
      gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(step.count), GL_UNSIGNED_SHORT,
                                 reinterpret_cast<const void*>(step.first * sizeof(ImDrawIdx)),
                                 static_cast<GLint>(command.VtxOffset));
    }
  }
}

std::vector<PixelRect> ImguiRenderer::draw_changes(const ImDrawData& data) {
  const PixelRect frame = frame_of(data);
  if (!canvas_ || canvas_->width() != frame.width || canvas_->height() != frame.height)
    canvas_.emplace(gl_, frame.width, frame.height);
  const std::vector<TriangleRects> triangles = triangles_of(data);
  std::vector<PixelRect> parts = changes_.follow(data, triangles);
  if (parts.empty()) return parts;
  canvas_->bind();
  begin(data);
  for (const PixelRect& part : parts) clear(gl_, part, IM_COL32_BLACK);
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    bool sent = false;
    for (const PixelRect& part : parts) {
      const std::vector<Step> steps = steps_of(data, list, triangles[static_cast<std::size_t>(n)], part);
      if (steps.empty()) continue;
      if (!std::exchange(sent, true))
        vertices_.assign(std::as_bytes(std::span(list.VtxBuffer.begin(), list.VtxBuffer.end())));
      draw(data, steps);
    }
  }
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
  return parts;
}

void ImguiRenderer::render(const ImDrawData& data) {
  static_assert(sizeof(ImDrawIdx) == 2, "draw() says GL_UNSIGNED_SHORT");
  if (frame_of(data).empty()) return;
  gl_.ActiveTexture(GL_TEXTURE0);
  std::vector<PixelRect> changed = draw_changes(data);
  if (std::exchange(window_lost_, false)) changed = {frame_of(data)};
  for (const PixelRect& part : changed) canvas_->copy_to_window(part);
}

PremultipliedImages::PremultipliedImages(ImDrawList& list) : list_(list) {
  list_.AddCallback(premultiplied_mark, nullptr);
}

PremultipliedImages::~PremultipliedImages() { list_.AddCallback(straight_mark, nullptr); }

}  // namespace patina
