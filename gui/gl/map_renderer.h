#pragma once

#include <optional>

#include "gui/gl/objects.h"
#include "gui/gl/surface_textures.h"
#include "gui/preview/preview_view.h"

namespace patina {

/// One of a surface's maps as a picture: base colour through the sRGB curve, normals as (n + 1) / 2, heights
/// from black (lowest) to white, roughness as it is.
class MapRenderer {
 public:
  /// @throws UserError if the shaders are missing or do not compile
  explicit MapRenderer(const Gl& gl);

  /// Draws a map into texture(). @return false, and nothing is drawn, where the surface has no such map
  bool render(const SurfaceTextures& maps, Subject map);

  const Texture& texture() const { return target_->texture(); }
  Image read() const { return target_->read_rgb(); }

 private:
  const Gl& gl_;
  Program program_;
  VertexArray empty_;
  std::optional<Framebuffer> target_;
};

}  // namespace patina
