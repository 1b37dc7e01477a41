#pragma once

#include <cmath>

#include "engine/image.h"

namespace patina {

/// What no material looks like.
inline Image green_hole_in_white() {
  Image image(48, 48, 3);
  for (int row = 0; row < 48; ++row)
    for (int column = 0; column < 48; ++column) {
      const bool hole = std::hypot(row - 23.5, column - 23.5) < 16;
      image.at(row, column, 0) = hole ? 0 : 0.9F;
      image.at(row, column, 1) = 0.9F;
      image.at(row, column, 2) = hole ? 0 : 0.9F;
    }
  return image;
}

}  // namespace patina
