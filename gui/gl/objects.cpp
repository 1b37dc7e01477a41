#include "gui/gl/objects.h"

#include "engine/error.h"

namespace patina {
namespace {

template <class Generate>
GLuint generate(Generate generate_names) {
  GLuint name = 0;
  generate_names(1, &name);
  return name;
}

std::string size_in_words(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

}  // namespace

Buffer::Buffer(const Gl& gl, GLenum target)
    : name_(gl, generate(gl.GenBuffers), [](const Gl& g, GLuint name) { g.DeleteBuffers(1, &name); }),
      target_(target) {}

void Buffer::bind() const { name_.gl().BindBuffer(target_, name_.get()); }

void Buffer::assign(std::span<const std::byte> bytes) {
  bind();
  while (capacity_ < bytes.size()) capacity_ = capacity_ == 0 ? 4096 : 2 * capacity_;
  // Orphaned first, so that the driver need not wait for draws that still read the old contents.
  name_.gl().BufferData(target_, static_cast<GLsizeiptr>(capacity_), nullptr, GL_STREAM_DRAW);
  name_.gl().BufferSubData(target_, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

VertexArray::VertexArray(const Gl& gl)
    : name_(gl, generate(gl.GenVertexArrays),
            [](const Gl& g, GLuint name) { g.DeleteVertexArrays(1, &name); }) {}

void VertexArray::bind() const { name_.gl().BindVertexArray(name_.get()); }

void VertexArray::attribute(GLuint index, GLint components, GLenum type, bool normalized, std::size_t stride,
                            std::size_t offset) const {
  bind();
  name_.gl().EnableVertexAttribArray(index);
  name_.gl().VertexAttribPointer(index, components, type, normalized, static_cast<GLsizei>(stride),
                                 reinterpret_cast<const void*>(offset));
}

Framebuffer::Framebuffer(const Gl& gl, int width, int height, TextureFilter filter)
    : texture_(Texture::rgba8(gl, width, height, {}, filter)),
      name_(gl, generate(gl.GenFramebuffers),
            [](const Gl& g, GLuint name) { g.DeleteFramebuffers(1, &name); }) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, name_.get());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
  const bool complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!complete) {
    throw UserError("The graphics driver cannot draw into a picture of " + size_in_words(width, height) +
                    "; choose a lower resolution.");
  }
}

void Framebuffer::bind() {
  const Gl& gl = name_.gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, name_.get());
  gl.Viewport(0, 0, width(), height());
  gl.Disable(GL_SCISSOR_TEST);
  texture_.changed();
}

void Framebuffer::copy_to_window(const PixelRect& part) const {
  const Gl& gl = name_.gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, name_.get());
  gl.Disable(GL_SCISSOR_TEST);
  const GLint right = part.left + part.width, bottom = part.top + part.height;
  gl.BlitFramebuffer(part.left, part.top, right, bottom, part.left, height() - part.top, right,
                     height() - bottom, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

Image Framebuffer::read_rgb() const {
  const Image rgba = read();
  Image rgb(rgba.width, rgba.height, 3);
  for (std::size_t i = 0, n = rgb.pixels.size() / 3; i < n; ++i) {
    for (std::size_t c = 0; c < 3; ++c) rgb.pixels[3 * i + c] = rgba.pixels[4 * i + c];
  }
  return rgb;
}

}  // namespace patina
