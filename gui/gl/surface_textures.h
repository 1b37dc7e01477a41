#pragma once

#include <array>
#include <vector>

#include "engine/material/maps.h"
#include "gui/gl/objects.h"

namespace patina {

/// A surface's maps on the device, as floats: what the shaders of the preview look up.
class SurfaceTextures {
 public:
  static constexpr int kMaxLobes = 4;

  explicit SurfaceTextures(const Gl& gl) : gl_(gl) {}

  /// Uploads the maps. @throws UserError if the device cannot hold a texture this large; there are none then
  void set(const MaterialMaps& maps);

  bool empty() const { return textures_.empty(); }
  int version() const { return version_; }  ///< grows with every set()
  int resolution() const { return textures_.front().width(); }
  const Capture& capture() const { return capture_; }
  float light() const { return light_; }
  float vignette_sigma() const { return vignette_sigma_; }

  /// Binds all maps and sets the uniforms that name them: base_color, normal, lobe_count, and of each lobe
  /// lobe_normal_K, roughness_K and f0_K. The program is in use.
  void bind(const Program& program) const;

  /// Makes the maps filtered, also beyond their edges, as shapes need them. Does nothing if they are already.
  /// @param wrap  GL_REPEAT or GL_MIRRORED_REPEAT
  void filter_beyond_edges(GLint wrap);

  // Single maps, to be looked at.
  const Texture& base_color() const { return textures_[0]; }
  const Texture& normal() const { return textures_[1]; }
  const Texture& height() const { return textures_[2]; }
  const Texture* roughness() const;  ///< of the first lobe, x and y; null without lobes
  std::array<float, 2> height_range() const { return height_range_; }  ///< cm

 private:
  /// The textures of one lobe; `normal` indexes textures_, since lobes often share the diffuse normal.
  struct LobeTextures {
    std::size_t normal = 0, roughness = 0;
    std::array<float, 3> f0{};
  };

  const Gl& gl_;
  std::vector<Texture> textures_;  ///< base colour, diffuse normal, height, then what the lobes add
  std::vector<LobeTextures> lobes_;
  std::array<float, 2> height_range_{};
  Capture capture_;
  float light_ = 0, vignette_sigma_ = 1;
  GLint wrap_ = 0;  ///< of textures that are filtered; 0: they are not
  int version_ = 0;
};

}  // namespace patina
