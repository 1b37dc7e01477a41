#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/image.h"

namespace patina {

/// A square of a photo, in pixels of the whole, upright one; x to the right, y down.
struct PhotoCrop {
  int x = 0, y = 0;  ///< of its top left corner
  int side = 0;
  bool operator==(const PhotoCrop&) const = default;
};

/// The largest square in the middle.
PhotoCrop central_crop(int width, int height);

/// A photograph ready for inference.
struct Photo {
  Image image;  ///< the cropped square, 3 channels, sRGB in [0,1], EXIF rotation applied
  PhotoCrop crop;
  int original_width = 0;  ///< after rotation, before the crop
  int original_height = 0;
  std::string sha256;  ///< of the file, hexadecimal
  Image whole;         ///< before the crop, reduced; empty unless it was asked for
  /// The camera's focal length in pixels of the whole photo, as far as EXIF tells.
  std::optional<double> focal_pixels;
  std::vector<std::string>
      warnings;  ///< sentences a user should see: "not a number in 12 pixels, taken as black"
};

constexpr int kMinPhotoSide = 32;  ///< pixels
constexpr int kMaxPhotoSide = 16384;
constexpr int kWorkingPhotoSide = 1024;  ///< larger squares are reduced to this

struct PhotoOptions {
  std::optional<PhotoCrop> crop = {};  ///< none: the central one
  int whole_side = 0;                  ///< pixels of the longer side of Photo::whole; 0: it is left out
};

/// Reads JPEG, PNG, TIFF, EXR, WebP, JPEG 2000, Radiance HDR, BMP and PPM by their contents: grey,
/// alpha, 16-bit, CMYK and linear ones included. EXR and other floats are taken as linear and clipped at
/// white.
/// @throws UserError with one sentence for anything that is not a usable photo, and for a crop that does not
/// lie inside it or is too small
Photo load_photo(const std::filesystem::path& file, const PhotoOptions& options = {});

/// Area-averaged or Lanczos resampling, of display values.
Image resized(const Image& image, int width, int height);
Image resized(const Image& image, int side);  ///< of a square image

}  // namespace patina
