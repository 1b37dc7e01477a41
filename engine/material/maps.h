#pragma once

#include <array>
#include <vector>

#include "engine/image.h"
#include "engine/material/capture.h"

namespace patina {

/// A lobe of a surface as plain images (see surface.h for the model).
struct LobeMaps {
  Image normal;               ///< 3 channels, unit vectors
  Image roughness;            ///< 2 channels: x, y
  std::array<float, 3> f0{};  ///< linear RGB
};

/// A surface as plain images: what the preview shades and the export writes. Crosses threads freely.
struct MaterialMaps {
  Image base_color;  ///< 3 channels, linear RGB
  Image height;      ///< 1 channel, cm
  Image normal;      ///< 3 channels, the diffuse normal
  std::vector<LobeMaps> lobes;
  float light = 0;
  float vignette_sigma = 1;  ///< cm
  Capture capture;

  int resolution() const { return base_color.width; }
};

}  // namespace patina
