#pragma once

#include <imgui.h>

#include <cstddef>
#include <optional>
#include <vector>

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

  /// Tells that the window's own framebuffer no longer holds the last frame, as after a swap of buffers.
  void lose_window() { window_lost_ = true; }

 private:
  void begin(const ImDrawData& data) const;
  /// What is to be done of a command: triangles, a large fill, or its callback.
  struct Step {
    const ImDrawCmd* command;
    PixelRect clip;
    std::size_t first, count;   ///< of kept_
    std::optional<ImU32> fill;  ///< to clear the clip rectangle to
  };
  std::vector<PixelRect> draw_changes(const ImDrawData& data);  ///< @return where
  std::vector<Step> steps_of(const ImDrawData& data, const ImDrawList& list, const TriangleRects& triangles,
                             const PixelRect& part);
  void draw(const ImDrawData& data, const std::vector<Step>& steps);

  const Gl& gl_;
  Program program_;
  VertexArray layout_;
  Buffer vertices_, indices_;
  std::optional<Texture> fonts_;
  std::vector<ImDrawIdx> kept_;  ///< indices of the triangles that touch the part that is drawn
  FrameChanges changes_;
  std::optional<Framebuffer> canvas_;  ///< the last frame
  bool window_lost_ = true;
};

/// While it lives, images that are added to a list are those whose colours are already multiplied by their
/// opacity.
class PremultipliedImages {
 public:
  explicit PremultipliedImages(ImDrawList& list);
  ~PremultipliedImages();
  PremultipliedImages(const PremultipliedImages&) = delete;
  PremultipliedImages& operator=(const PremultipliedImages&) = delete;

 private:
  ImDrawList& list_;
};

}  // namespace patina
