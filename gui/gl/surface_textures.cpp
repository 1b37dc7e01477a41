#include "gui/gl/surface_textures.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

namespace patina {

void SurfaceTextures::set(const MaterialMaps& maps) {
  assert(maps.lobes.size() <= kMaxLobes);
  // The old maps go first: at 4096 pixels a side two sets may not fit.
  lobes_.clear();
  textures_.clear();
  std::vector<Texture> textures;
  std::vector<LobeTextures> lobes;
  textures.push_back(Texture::floats(gl_, maps.base_color));
  textures.push_back(Texture::floats(gl_, maps.normal));
  textures.push_back(Texture::floats(gl_, maps.height));
  for (const LobeMaps& lobe : maps.lobes) {
    assert(lobe.normal.width == maps.resolution() && lobe.roughness.width == maps.resolution() &&
           lobe.roughness.channels == 2);
    LobeTextures places{1, textures.size(), lobe.f0};
    textures.push_back(Texture::floats(gl_, lobe.roughness));
    if (lobe.normal.pixels != maps.normal.pixels) {
      places.normal = textures.size();
      textures.push_back(Texture::floats(gl_, lobe.normal));
    }
    lobes.push_back(places);
  }
  textures_ = std::move(textures);
  lobes_ = std::move(lobes);
  const auto [low, high] = std::ranges::minmax(maps.height.pixels);
  height_range_ = {low, high};
  capture_ = maps.capture;
  light_ = maps.light;
  vignette_sigma_ = maps.vignette_sigma;
  wrap_ = 0;
  ++version_;
}

void SurfaceTextures::bind(const Program& program) const {
  auto set_texture = [&, unit = 0](const std::string& name, std::size_t texture) mutable {
    textures_[texture].bind(unit);
    gl_.Uniform1i(program.location(name.c_str()), unit++);
  };
  gl_.Uniform1i(program.location("lobe_count"), static_cast<GLint>(lobes_.size()));
  set_texture("base_color", 0);
  set_texture("normal", 1);
  for (std::size_t k = 0; k < kMaxLobes; ++k) {
    // A sampler without a lobe still needs a texture that is complete.
    const LobeTextures lobe = k < lobes_.size() ? lobes_[k] : LobeTextures{};
    const std::string suffix = "_" + std::to_string(k);
    set_texture("lobe_normal" + suffix, lobe.normal);
    set_texture("roughness" + suffix, lobe.roughness);
    gl_.Uniform3f(program.location(("f0" + suffix).c_str()), lobe.f0[0], lobe.f0[1], lobe.f0[2]);
  }
}

void SurfaceTextures::filter_beyond_edges(GLint wrap) {
  if (wrap_ == wrap) return;
  for (const Texture& texture : textures_) texture.filter_beyond_edges(wrap);
  wrap_ = wrap;
}

const Texture* SurfaceTextures::roughness() const {
  return lobes_.empty() ? nullptr : &textures_[lobes_.front().roughness];
}

}  // namespace patina
