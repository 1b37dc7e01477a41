#include "gui/gl/picture_comparer.h"

#include <cmath>

namespace patina {

PictureComparer::PictureComparer(const Gl& gl)
    : gl_(gl), program_(Program::load(gl, "fullscreen", "compare")), empty_(gl) {}

const Framebuffer& PictureComparer::draw(std::optional<Framebuffer>& target, int side, const Texture& picture,
                                         const Texture& other, float stops) {
  if (!target || target->width() != side) target.emplace(gl_, side, side);
  target->bind();
  gl_.Disable(GL_BLEND);
  picture.bind(0);
  other.bind(1);
  gl_.Uniform1i(program_.location("picture"), 0);
  gl_.Uniform1i(program_.location("other"), 1);
  gl_.Uniform2f(program_.location("size"), static_cast<float>(side), static_cast<float>(side));
  gl_.Uniform1f(program_.location("factor"), std::exp2(stops));
  empty_.bind();
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  return *target;
}

const Texture& PictureComparer::exposed(const Texture& picture, float stops, int side, int slot) {
  program_.use();
  gl_.Uniform1i(program_.location("difference"), false);
  return draw(targets_[slot], side, picture, picture, stops).texture();
}

const Texture& PictureComparer::difference(const Texture& first, const Texture& second, const Difference& how,
                                           int side) {
  program_.use();
  gl_.Uniform1i(program_.location("difference"), true);
  gl_.Uniform1i(program_.location("signed_difference"), how.is_signed);
  gl_.Uniform1f(program_.location("gain"), how.gain);
  return draw(targets_[0], side, first, second, how.stops).texture();
}

}  // namespace patina
