#include "gui/gl/multisampled.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "engine/error.h"

namespace patina {
namespace {

constexpr GLint kSamples = 4;

GlName renderbuffer(const Gl& gl, GLenum format, int width, int height) {
  GLuint name = 0;
  gl.GenRenderbuffers(1, &name);
  GlName owned(gl, name, [](const Gl& g, GLuint object) { g.DeleteRenderbuffers(1, &object); });
  GLint most = 0;
  gl.GetIntegerv(GL_MAX_SAMPLES, &most);
  gl.BindRenderbuffer(GL_RENDERBUFFER, name);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, std::min(kSamples, most), format, width, height);
  return owned;
}

GlName framebuffer(const Gl& gl) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  return {gl, name, [](const Gl& g, GLuint object) { g.DeleteFramebuffers(1, &object); }};
}

}  // namespace

MultisampledFramebuffer::MultisampledFramebuffer(const Gl& gl, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      color_(renderbuffer(gl, GL_RGBA8, width, height)),
      depth_(renderbuffer(gl, GL_DEPTH_COMPONENT24, width, height)),
      name_(framebuffer(gl)) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, name_.get());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.get());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.get());
  const bool complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!complete) {
    throw UserError("The graphics driver cannot draw solids into a picture of " + std::to_string(width) +
                    " x " + std::to_string(height) + " pixels; make the window smaller.");
  }
}

void MultisampledFramebuffer::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, name_.get());
  gl_.Viewport(0, 0, width_, height_);
  gl_.Disable(GL_SCISSOR_TEST);
}

void MultisampledFramebuffer::resolve_into(Framebuffer& target) {
  assert(target.width() == width_ && target.height() == height_);
  target.bind();
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, name_.get());
  gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace patina
