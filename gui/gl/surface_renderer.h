#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/material/maps.h"
#include "gui/gl/objects.h"

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
  static constexpr int kMaxLobes = 4;

  /// @throws UserError if the shaders are missing or do not compile
  explicit SurfaceRenderer(const Gl& gl);

  /// Uploads the maps, as floats. @throws UserError if the device cannot hold a texture this large
  void set_maps(const MaterialMaps& maps);

  /// Draws the maps into texture(); set_maps() comes first.
  void render(const SurfaceView& view = {});

  bool has_maps() const { return target_.has_value(); }

  /// The render, display values, opaque; as many pixels as the maps have. Mipmapped, so that it can be shown
  /// at any size.
  const Texture& texture() const { return target_->texture(); }
  Image read() const;  ///< the render as 3 channels in [0,1]

 private:
  /// The textures of one lobe; `normal` indexes textures_, since lobes often share the diffuse normal.
  struct LobeTextures {
    std::size_t normal = 0, roughness = 0;
    std::array<float, 3> f0{};
  };
  void set_uniforms(const SurfaceView& view) const;

  const Gl& gl_;
  Program program_;
  VertexArray empty_;
  std::vector<Texture> textures_;  ///< base colour, diffuse normal, then what the lobes add
  std::vector<LobeTextures> lobes_;
  Capture capture_;
  float light_ = 0, vignette_sigma_ = 1;
  std::optional<Framebuffer> target_;
};

}  // namespace patina
