#include "gui/gl/surface_renderer.h"

#include <cassert>
#include <cmath>
#include <string>

namespace patina {

SurfaceRenderer::SurfaceRenderer(const Gl& gl)
    : gl_(gl), program_(Program::load(gl, "fullscreen", "surface")), empty_(gl) {}

void SurfaceRenderer::set_maps(const MaterialMaps& maps) {
  assert(maps.lobes.size() <= kMaxLobes);
  const int n = maps.resolution();
  // The old maps go first: at 4096 pixels a side two sets may not fit.
  lobes_.clear();
  textures_.clear();
  textures_.push_back(Texture::floats(gl_, maps.base_color));
  textures_.push_back(Texture::floats(gl_, maps.normal));
  for (const LobeMaps& lobe : maps.lobes) {
    assert(lobe.normal.width == n && lobe.roughness.width == n && lobe.roughness.channels == 2);
    LobeTextures textures{1, 0, lobe.f0};
    if (lobe.normal.pixels != maps.normal.pixels) {
      textures.normal = textures_.size();
      textures_.push_back(Texture::floats(gl_, lobe.normal));
    }
    textures.roughness = textures_.size();
    textures_.push_back(Texture::floats(gl_, lobe.roughness));
    lobes_.push_back(textures);
  }
  capture_ = maps.capture;
  light_ = maps.light;
  vignette_sigma_ = maps.vignette_sigma;
  if (!target_ || target_->width() != n) target_.emplace(gl_, n, n, TextureFilter::mipmapped);
}

void SurfaceRenderer::set_uniforms(const SurfaceView& view) const {
  const auto set = [&](const char* name, double value) {
    gl_.Uniform1f(program_.location(name), static_cast<float>(value));
  };
  auto set_texture = [&, unit = 0](const std::string& name, std::size_t texture) mutable {
    textures_[texture].bind(unit);
    gl_.Uniform1i(program_.location(name.c_str()), unit++);
  };
  set("resolution", target_->width());
  set("size_cm", capture_.size_cm);
  set("camera_cm", capture_.camera_cm);
  set("vignette_sigma", vignette_sigma_);
  set("light", light_ * std::exp2(view.exposure));
  gl_.Uniform1i(program_.location("srgb"), view.curve == DisplayCurve::srgb);
  gl_.Uniform1i(program_.location("lobe_count"), static_cast<GLint>(lobes_.size()));
  set_texture("base_color", 0);
  set_texture("normal", 1);
  for (std::size_t k = 0; k < kMaxLobes; ++k) {
    // A sampler without a lobe still needs a texture that is complete.
    const LobeTextures lobe = k < lobes_.size() ? lobes_[k] : LobeTextures{};
    const std::string suffix = "_" + std::to_string(k);
    set_texture("lobe_normal" + suffix, lobe.normal);
    set_texture("roughness" + suffix, lobe.roughness);
    gl_.Uniform3f(program_.location(("f0" + suffix).c_str()), lobe.f0[0], lobe.f0[1], lobe.f0[2]);
  }
}

void SurfaceRenderer::render(const SurfaceView& view) {
  assert(has_maps());
  target_->bind();
  gl_.Disable(GL_BLEND);
  program_.use();
  set_uniforms(view);
  empty_.bind();
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  target_->texture().generate_mipmaps();
}

Image SurfaceRenderer::read() const {
  const Image rgba = target_->read();
  Image rgb(rgba.width, rgba.height, 3);
  for (std::size_t i = 0, n = rgb.pixels.size() / 3; i < n; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgb.pixels[3 * i + c] = rgba.pixels[4 * i + c];
  }
  return rgb;
}

}  // namespace patina
