#pragma once

#include "gui/gl/objects.h"

namespace patina {

/// Somewhere to draw solids with smooth outlines: colour and depth of several samples a pixel.
class MultisampledFramebuffer {
 public:
  /// @throws UserError if the driver refuses the size
  MultisampledFramebuffer(const Gl& gl, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  void bind() const;                       ///< draw here, all of it
  void resolve_into(Framebuffer& target);  ///< of the same size; nothing is bound after it

 private:
  const Gl& gl_;
  int width_, height_;
  GlName color_, depth_, name_;
};

}  // namespace patina
