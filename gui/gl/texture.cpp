#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <vector>

#include "engine/error.h"
#include "gui/gl/objects.h"

namespace patina {
namespace {

/// How an image of 1 to 4 float channels is stored and handed over.
struct FloatFormat {
  GLint stored;
  GLenum given;
};

FloatFormat float_format(int channels) {
  static constexpr std::array<FloatFormat, 4> kFormats{
      FloatFormat{GL_R32F, GL_RED}, {GL_RG32F, GL_RG}, {GL_RGB32F, GL_RGB}, {GL_RGBA32F, GL_RGBA}};
  assert(channels >= 1 && channels <= 4);
  return kFormats[static_cast<std::size_t>(channels - 1)];
}

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

std::vector<std::uint8_t> to_rgba8(const Image& image) {
  assert(image.channels == 1 || image.channels == 3 || image.channels == 4);
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
  std::vector<std::uint8_t> bytes(4 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const float* pixel = &image.pixels[i * image.channels];
    for (int c = 0; c < 3; ++c) bytes[4 * i + c] = to_byte(pixel[image.channels == 1 ? 0 : c]);
    bytes[4 * i + 3] = image.channels == 4 ? to_byte(pixel[3]) : 255;
  }
  return bytes;
}

GLuint make_texture(const Gl& gl, int width, int height) {
  GLint limit = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width < 1 || height < 1 || width > limit || height > limit) {
    throw UserError("The graphics driver cannot hold a picture of " + std::to_string(width) + " x " +
                    std::to_string(height) + " pixels (at most " + std::to_string(limit) +
                    " a side); choose a lower resolution.");
  }
  GLuint name = 0;
  gl.GenTextures(1, &name);
  return name;
}

}  // namespace

Texture::Texture(const Gl& gl, int width, int height, TextureFilter filter)
    : name_(gl, make_texture(gl, width, height),
            [](const Gl& g, GLuint name) { g.DeleteTextures(1, &name); }),
      width_(width),
      height_(height) {
  changed();
  const GLint shrunk = filter == TextureFilter::nearest  ? GL_NEAREST
                       : filter == TextureFilter::linear ? GL_LINEAR
                                                         : GL_LINEAR_MIPMAP_LINEAR;
  bind(0);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, shrunk);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER,
                   filter == TextureFilter::nearest ? GL_NEAREST : GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

Texture Texture::picture(const Gl& gl, const Image& image) {
  Texture texture = rgba8(gl, image.width, image.height, to_rgba8(image), TextureFilter::mipmapped);
  texture.generate_mipmaps();
  return texture;
}

Texture Texture::floats(const Gl& gl, const Image& image) {
  Texture texture(gl, image.width, image.height, TextureFilter::nearest);
  const FloatFormat format = float_format(image.channels);
  gl.TexImage2D(GL_TEXTURE_2D, 0, format.stored, image.width, image.height, 0, format.given, GL_FLOAT,
                image.pixels.data());
  return texture;
}

Texture Texture::rgba8(const Gl& gl, int width, int height, std::span<const std::uint8_t> bytes,
                       TextureFilter filter) {
  assert(bytes.empty() || bytes.size() == 4 * static_cast<std::size_t>(width) * height);
  Texture texture(gl, width, height, filter);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                bytes.empty() ? nullptr : bytes.data());
  return texture;
}

void Texture::bind(int unit) const {
  gl().ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl().BindTexture(GL_TEXTURE_2D, name());
}

void Texture::generate_mipmaps() const {
  bind(0);
  gl().GenerateMipmap(GL_TEXTURE_2D);
}

void Texture::filter_beyond_edges(GLint wrap) const {
  generate_mipmaps();
  gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
}

void Texture::update(const Image& image) {
  assert(image.width == width_ && image.height == height_);
  bind(0);
  gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, float_format(image.channels).given, GL_FLOAT,
                     image.pixels.data());
  changed();
}

void Texture::update(int left, int top, int width, int height, std::span<const std::uint8_t> bytes) {
  assert(bytes.size() == 4 * static_cast<std::size_t>(width) * height);
  assert(left >= 0 && top >= 0 && left + width <= width_ && top + height <= height_);
  bind(0);
  gl().TexSubImage2D(GL_TEXTURE_2D, 0, left, top, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  changed();
}

void Texture::changed() {
  static std::atomic<std::uint32_t> last = 0;
  contents_ = ++last;
}

Image Texture::read() const {
  Image image(width_, height_, 4);
  bind(0);
  gl().GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, image.pixels.data());
  return image;
}

}  // namespace patina
