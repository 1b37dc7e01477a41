#pragma once

#include <optional>

#include "gui/gl/objects.h"

namespace patina {

/// Pictures at another exposure, and how two of them differ; all are display values (sRGB).
class PictureComparer {
 public:
  /// @throws UserError if the shaders are missing or do not compile
  explicit PictureComparer(const Gl& gl);

  /// The picture 2^stops times as bright, white where it was clipped or is now. The same texture until the
  /// next call of the same `slot`, of which there are two. @param side  of the result, pixels
  const Texture& exposed(const Texture& picture, float stops, int side, int slot);

  struct Difference {
    float stops = 0;
    float gain = 1;
    bool is_signed = false;  ///< grey where equal, brighter where the first is; else |first - second|
  };
  /// gain (first - second) of both exposed pictures.
  const Texture& difference(const Texture& first, const Texture& second, const Difference& how, int side);

 private:
  const Framebuffer& draw(std::optional<Framebuffer>& target, int side, const Texture& picture,
                          const Texture& other, float stops);

  const Gl& gl_;
  Program program_;
  VertexArray empty_;
  std::optional<Framebuffer> targets_[2];
};

}  // namespace patina
