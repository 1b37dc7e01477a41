#pragma once

#include <optional>
#include <utility>

#include "engine/material/maps.h"
#include "gui/gl/objects.h"
#include "gui/gl/surface_textures.h"

namespace patina {

/// How a surface is looked at.
struct SurfaceView {
  DisplayCurve curve = DisplayCurve::srgb;
  float exposure = 0;  ///< stops: radiance times 2^exposure
};

/// The preview: shades maps under the capture light as the engine does (engine/material/shading.h), on the
/// device.
class SurfaceRenderer {
 public:
  static constexpr int kMaxLobes = SurfaceTextures::kMaxLobes;

  /// @param filter  how its render is looked up
  /// @throws UserError if the shaders are missing or do not compile
  explicit SurfaceRenderer(const Gl& gl, TextureFilter filter = TextureFilter::mipmapped);

  /// Uploads the maps. @throws UserError if the device cannot hold a texture this large
  void set_maps(const MaterialMaps& maps) { textures_.set(maps); }
  SurfaceTextures& textures() { return textures_; }
  const SurfaceTextures& textures() const { return textures_; }

  /// Draws the maps into texture(); set_maps() comes first.
  void render(const SurfaceView& view = {});

  bool has_render() const { return target_.has_value(); }

  /// The render, display values, opaque; as many pixels as the maps have.
  const Texture& texture() const { return target_->texture(); }
  Image read() const { return target_->read_rgb(); }  ///< the render as 3 channels in [0,1]
  /// The render itself; the next one is drawn elsewhere.
  Framebuffer take() { return *std::exchange(target_, std::nullopt); }

 private:
  void set_uniforms(const SurfaceView& view) const;

  const Gl& gl_;
  TextureFilter filter_;  ///< mipmapped: it can be shown at any size
  Program program_;
  VertexArray empty_;
  SurfaceTextures textures_;
  std::optional<Framebuffer> target_;
};

}  // namespace patina
