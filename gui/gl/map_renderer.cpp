#include "gui/gl/map_renderer.h"

#include <cassert>

namespace patina {
namespace {

const Texture* map_of(const SurfaceTextures& maps, Subject map) {
  switch (map) {
    case Subject::base_color:
      return &maps.base_color();
    case Subject::normal:
      return &maps.normal();
    case Subject::roughness:
      return maps.roughness();
    default:
      return &maps.height();
  }
}

}  // namespace

MapRenderer::MapRenderer(const Gl& gl)
    : gl_(gl), program_(Program::load(gl, "fullscreen", "map")), empty_(gl) {}

bool MapRenderer::render(const SurfaceTextures& maps, Subject map) {
  assert(is_map(map) && !maps.empty());
  const Texture* texture = map_of(maps, map);
  if (texture == nullptr) return false;
  const int n = maps.resolution();
  if (!target_ || target_->width() != n) target_.emplace(gl_, n, n, TextureFilter::mipmapped);
  target_->bind();
  gl_.Disable(GL_BLEND);
  program_.use();
  texture->bind(0);
  gl_.Uniform1i(program_.location("map"), 0);
  gl_.Uniform1i(program_.location("kind"), static_cast<int>(map) - static_cast<int>(Subject::base_color));
  gl_.Uniform1f(program_.location("low"), maps.height_range()[0]);
  gl_.Uniform1f(program_.location("high"), maps.height_range()[1]);
  empty_.bind();
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  target_->texture().generate_mipmaps();
  return true;
}

}  // namespace patina
