#include "gui/gl/surface_renderer.h"

#include <cassert>
#include <cmath>

namespace patina {

SurfaceRenderer::SurfaceRenderer(const Gl& gl, TextureFilter filter)
    : gl_(gl),
      filter_(filter),
      program_(Program::load(gl, "fullscreen", "surface")),
      empty_(gl),
      textures_(gl) {}

void SurfaceRenderer::set_uniforms(const SurfaceView& view) const {
  const auto set = [&](const char* name, double value) {
    gl_.Uniform1f(program_.location(name), static_cast<float>(value));
  };
  set("resolution", textures_.resolution());
  set("size_cm", textures_.capture().size_cm);
  set("camera_cm", textures_.capture().camera_cm);
  set("vignette_sigma", textures_.vignette_sigma());
  set("light", textures_.light() * std::exp2(view.exposure));
  gl_.Uniform1i(program_.location("srgb"), view.curve == DisplayCurve::srgb);
  textures_.bind(program_);
}

void SurfaceRenderer::render(const SurfaceView& view) {
  assert(!textures_.empty());
  const int n = textures_.resolution();
  if (!target_ || target_->width() != n) target_.emplace(gl_, n, n, filter_);
  target_->bind();
  gl_.Disable(GL_BLEND);
  program_.use();
  set_uniforms(view);
  empty_.bind();
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  if (filter_ == TextureFilter::mipmapped) target_->texture().generate_mipmaps();
}

}  // namespace patina
