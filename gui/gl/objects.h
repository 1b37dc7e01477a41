#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "engine/image.h"
#include "gui/gl/functions.h"
#include "gui/gl/pixel_rect.h"

namespace patina {

/// A GL name that is deleted with its owner. Move-only.
class GlName {
 public:
  using Delete = void (*)(const Gl&, GLuint);
  GlName(const Gl& gl, GLuint name, Delete remove) : gl_(&gl), name_(name), remove_(remove) {}
  GlName(GlName&& other) noexcept
      : gl_(other.gl_), name_(std::exchange(other.name_, 0)), remove_(other.remove_) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    std::swap(remove_, other.remove_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) remove_(*gl_, name_);
  }
  GLuint get() const { return name_; }
  const Gl& gl() const { return *gl_; }

 private:
  const Gl* gl_;
  GLuint name_;
  Delete remove_;
};

enum class TextureFilter { nearest, linear, mipmapped };

/// A 2-D texture, clamped at its edges. Its first row is the top row of what it shows, so that Dear ImGui
/// draws it upright with texture coordinates from (0,0) to (1,1).
class Texture {
 public:
  /// Display values: clamped to [0,1] and stored in 8 bits. 1 (grey), 3 or 4 channels. For pictures that are
  /// looked at.
  static Texture picture(const Gl& gl, const Image& image);
  /// 32-bit floats as they are, 1 to 4 channels. For maps that are computed with.
  static Texture floats(const Gl& gl, const Image& image);
  /// Non-premultiplied RGBA bytes, width * height * 4. @param bytes  empty: undefined contents
  static Texture rgba8(const Gl& gl, int width, int height, std::span<const std::uint8_t> bytes,
                       TextureFilter filter);

  int width() const { return width_; }
  int height() const { return height_; }
  GLuint name() const { return name_.get(); }
  /// What Dear ImGui's drawing functions take (an ImTextureID): the name, and above it which contents, so
  /// that a frame with other contents is another frame.
  void* imgui_id() const {
    return std::bit_cast<void*>(static_cast<std::uintptr_t>(contents_) << 32 | name());
  }
  static GLuint name_in(void* imgui_id) {
    return static_cast<GLuint>(std::bit_cast<std::uintptr_t>(imgui_id));
  }

  void bind(int unit) const;
  void generate_mipmaps() const;  ///< after its contents changed, if its filter is mipmapped

  /// Looked up between its pixels and beyond its edges from now on, reduced where it is far away.
  /// @param wrap  GL_REPEAT or GL_MIRRORED_REPEAT
  void filter_beyond_edges(GLint wrap) const;

  /// Replaces the contents of a texture made by floats(); same size and channels.
  void update(const Image& image);
  /// Replaces a part of a texture made by rgba8(). @param bytes  width * height * 4
  void update(int left, int top, int width, int height, std::span<const std::uint8_t> bytes);
  void changed();  ///< told by whoever else has drawn into it

  Image read() const;  ///< what it holds: RGBA, rows from the top; bytes as [0,1]

 private:
  Texture(const Gl& gl, int width, int height, TextureFilter filter);
  const Gl& gl() const { return name_.gl(); }

  GlName name_;
  int width_, height_;
  std::uint32_t contents_ = 0;  ///< a number that no other texture has had
};

/// Vertices or indices on the device, rewritten often. Grows by doubling.
class Buffer {
 public:
  Buffer(const Gl& gl, GLenum target);
  GLuint name() const { return name_.get(); }
  void bind() const;
  void assign(std::span<const std::byte> bytes);  ///< replaces all; binds it

 private:
  GlName name_;
  GLenum target_;
  std::size_t capacity_ = 0;
};

class VertexArray {
 public:
  explicit VertexArray(const Gl& gl);
  void bind() const;
  /// Declares an attribute of the buffer that is bound to GL_ARRAY_BUFFER.
  void attribute(GLuint index, GLint components, GLenum type, bool normalized, std::size_t stride,
                 std::size_t offset) const;

 private:
  GlName name_;
};

/// Somewhere to draw besides the window: an RGBA8 texture, its first row the top (draw with y downwards).
class Framebuffer {
 public:
  /// @throws UserError if the driver refuses the size
  Framebuffer(const Gl& gl, int width, int height, TextureFilter filter = TextureFilter::linear);

  const Texture& texture() const { return texture_; }
  int width() const { return texture_.width(); }
  int height() const { return texture_.height(); }

  void bind();  ///< draw here, all of it: sets the viewport, scissor off
  /// To the same place, upright: the window's row 0 is at the bottom.
  void copy_to_window(const PixelRect& part) const;
  Image read() const { return texture_.read(); }
  Image read_rgb() const;  ///< without its opacity

 private:
  Texture texture_;
  GlName name_;
};

/// A vertex and a fragment shader, linked.
class Program {
 public:
  /// @throws UserError with the driver's own words, prefixed by `name`
  Program(const Gl& gl, const std::string& name, const std::string& vertex_source,
          const std::string& fragment_source);

  /// From shaders/VERTEX.vert and shaders/FRAGMENT.frag of data_directory().
  static Program load(const Gl& gl, const std::string& vertex, const std::string& fragment);

  void use() const;
  GLint location(const char* uniform) const;  ///< -1 (which setters ignore) for a uniform that is not used

 private:
  GlName name_;
};

}  // namespace patina
