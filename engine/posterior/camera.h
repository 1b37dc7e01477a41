#pragma once

#include "engine/image.h"
#include "engine/sampling/rng.h"

namespace patina {

/// What stands between a surface's image and the photo of it that is compared with renders.
struct Camera {
  int oversampling = 2;  ///< pixels of the photo for each that is compared, along a side
  /// Pixels of a side at least, of materials whose pixels are not their middles (Material::oversampling()):
  /// so that predictors, which look at half as many, are shown means as they are by photos.
  int least_side = 256;
  double electrons = 5000;  ///< that white frees in a pixel: shot noise is their square root
  double read_noise = 3;    ///< electrons, root mean square
  int jpeg_quality = 92;
};

/// A photo of a render: shot noise and read noise (in linear light, clipped at black and white), 8 bits,
/// JPEG.
/// @param render  3 channels, sRGB in [0,1]
Image photographed(const Image& render, const Camera& camera, Rng& rng);

}  // namespace patina
