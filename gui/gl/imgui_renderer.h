#pragma once

#include <imgui.h>

#include <optional>

#include "gui/gl/frame_changes.h"
#include "gui/gl/objects.h"

namespace patina {

/// Draws what Dear ImGui has laid out. Belongs to the current ImGui context; the windows own one each.
class ImguiRenderer {
 public:
  explicit ImguiRenderer(const Gl& gl);

  /// Uploads the font atlas if it is new or its fonts have been replaced. Before every ImGui::NewFrame().
  void prepare();

  /// Draws what has changed since the last frame, and shows it all in the window's own framebuffer.
  void render(const ImDrawData& data);

 private:
  void begin(const ImDrawData& data) const;
  void draw_changes(const ImDrawData& data);
  void draw(const ImDrawData& data, const ImDrawList& list, const PixelRect& part) const;
  void draw(const ImDrawData& data, const ImDrawList& list, const ImDrawCmd& command,
            const PixelRect& part) const;

  const Gl& gl_;
  Program program_;
  VertexArray layout_;
  Buffer vertices_, indices_;
  std::optional<Texture> fonts_;
  FrameChanges changes_;
  std::optional<Framebuffer> canvas_;  ///< the last frame
};

/// Adds an image whose colours are already multiplied by their opacity, as a PointRenderer makes them.
void add_premultiplied_image(ImDrawList& list, ImTextureID texture, ImVec2 top_left, ImVec2 bottom_right);

}  // namespace patina
