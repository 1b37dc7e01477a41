#pragma once

#include <filesystem>

#include "engine/image.h"

namespace patina {

enum class PixelDepth { u8, u16, f16, f32 };

/// Writes PNG, JPEG, TIFF or EXR by extension; the values are written as they are (display values in [0,1],
/// or floats for EXR), alpha included. A depth that the format lacks becomes the nearest one that it has.
/// Atomically: a reader sees the old file or the whole new one.
/// @throws UserError if the file cannot be written or the extension is unknown
void write_image(const std::filesystem::path& file, const Image& image, PixelDepth depth = PixelDepth::u8);

/// Reads any image that load_photo() can decode, as floats and as stored: integers as fractions of their
/// range, no colour conversion, no rotation (tests, photo.png of a run). @throws UserError
Image read_image(const std::filesystem::path& file);

}  // namespace patina
