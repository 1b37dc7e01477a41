#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/image.h"

namespace patina {

/// A photograph ready for inference.
struct Photo {
  Image image;             ///< the central square, 3 channels, sRGB in [0,1], EXIF rotation applied
  int original_width = 0;  ///< after rotation, before the crop
  int original_height = 0;
  std::string sha256;  ///< of the file, hexadecimal
  std::vector<std::string>
      warnings;  ///< sentences a user should see: "not a number in 12 pixels, taken as black"
};

constexpr int kMinPhotoSide = 32;  ///< pixels
constexpr int kMaxPhotoSide = 16384;
constexpr int kWorkingPhotoSide = 1024;  ///< larger squares are reduced to this

/// Reads JPEG, PNG, TIFF, EXR, WebP, JPEG 2000, Radiance HDR, BMP and PPM by their contents: grey,
/// alpha, 16-bit, CMYK and linear ones included. EXR and other floats are taken as linear and clipped at
/// white.
/// @throws UserError with one sentence for anything that is not a usable photo
Photo load_photo(const std::filesystem::path& file);

/// Area-averaged or Lanczos resampling of a square image to side x side.
Image resized(const Image& image, int side);

}  // namespace patina
