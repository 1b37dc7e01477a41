#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <functional>
#include <string>

#include "engine/image.h"

namespace patina {

/// What a test asks of a file beside its pixels.
struct FileKind {
  OIIO::TypeDesc type = OIIO::TypeDesc::UINT8;
  std::function<void(OIIO::ImageSpec&)> adjust = [](OIIO::ImageSpec&) {};
};

/// Writes an image through OpenImageIO, by extension, values as they are.
void write_test_image(const std::filesystem::path& file, const Image& image, const FileKind& kind = {});

/// An image with no symmetry: a different smooth ramp in every channel, values in [0.1, 0.9].
Image ramps(int width, int height, int channels);

/// The same value everywhere. @param values  one per channel
Image uniform(int width, int height, const std::vector<float>& values);

/// What rounding to 8 bits may be off by.
constexpr float kEightBit = 0.51f / 255;

/// The largest absolute difference; infinity where the sizes differ.
float max_difference(const Image& a, const Image& b);

/// The columns and rows [left, left + side) x [top, top + side).
Image crop(const Image& image, int left, int top, int side);

/// A minimal PNG header (signature, IHDR, and an IDAT that holds no pixels): 8-bit RGB of any claimed size.
std::string png_header(std::uint32_t width, std::uint32_t height);

/// The PNG with each chunk's checksum set right, as far as its chunks can be followed; other bytes as they
/// are. Without it a changed PNG is refused before anything in it is looked at.
std::string with_png_checksums(std::string bytes);

/// A whole baseline JPEG of one colour, written by hand because encoders offer no CMYK: every block has a DC
/// value only. @param components  samples 0 to 255 as stored, 1, 3 or 4 of them (4: Adobe CMYK, inverted)
std::string flat_jpeg(int width, int height, const std::vector<int>& components);

}  // namespace patina
