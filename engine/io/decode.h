#pragma once

#include <OpenImageIO/imagebuf.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/image.h"

namespace patina {

// Inside engine/io only: the headers that other parts see do not mention OpenImageIO.

/// An image as its file stores it: native type and channels, orientation not applied.
struct DecodedImage {
  OIIO::ImageBuf pixels;   ///< the data window, with its origin at (0, 0)
  OIIO::ImageSpec header;  ///< sizes, channel names, metadata
  std::string format;      ///< as in image_format()
  bool cmyk = false;       ///< stored as CMYK, whoever converted it to RGB
};

/// Decodes the first image of a file. Size, channels and memory are checked from the header, before anything
/// of their size is allocated.
/// @param bytes     the file's contents: they decide the format, and whether a JPEG is whole
/// @param min_side  pixels @param max_side  pixels
/// @throws UserError ("The image NAME is damaged ...") for all that is not a flat, whole image of that size
DecodedImage decode_image(const std::filesystem::path& file, std::string_view bytes, int min_side,
                          int max_side);

/// The buffer's values as floats: integers as fractions of their range, floats as they are.
/// @throws std::bad_alloc also for a buffer that OpenImageIO had no memory for, which it does not throw
Image to_image(const OIIO::ImageBuf& buffer);

/// A float buffer with a copy of the image's values.
OIIO::ImageBuf to_buffer(const Image& image);

/// Throws the UserError "The image NAME ...". @param why_and_cure  the rest of the sentence
[[noreturn]] void refuse_image(const std::filesystem::path& file, const std::string& why_and_cure);

}  // namespace patina
