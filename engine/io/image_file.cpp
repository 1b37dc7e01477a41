#include "engine/io/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/io/decode.h"
#include "engine/io/file.h"
#include "engine/io/photo.h"

namespace patina {
namespace {

OIIO::TypeDesc type_of(PixelDepth depth) {
  switch (depth) {
    case PixelDepth::u8:
      return OIIO::TypeDesc::UINT8;
    case PixelDepth::u16:
      return OIIO::TypeDesc::UINT16;
    case PixelDepth::f16:
      return OIIO::TypeDesc::HALF;
    case PixelDepth::f32:
      return OIIO::TypeDesc::FLOAT;
  }
  return OIIO::TypeDesc::UINT8;
}

/// OpenImageIO's name of the format that the extension asks for.
const char* format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::array<std::array<const char*, 2>, 6> kFormats{{{".png", "png"},
                                                                {".jpg", "jpeg"},
                                                                {".jpeg", "jpeg"},
                                                                {".tif", "tiff"},
                                                                {".tiff", "tiff"},
                                                                {".exr", "openexr"}}};
  for (const auto& [known, format] : kFormats)
    if (extension == known) return format;
  throw UserError("Cannot write the image " + file.string() +
                  ": give it a name that ends in .png, .jpg, .tif or .exr.");
}

}  // namespace

void write_image(const std::filesystem::path& file, const Image& image, PixelDepth depth) {
  // Encoded in memory: the encoders' own file output does not notice every failed write.
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format_of(file), &memory);
  OIIO::ImageSpec spec(image.width, image.height, image.channels, type_of(depth));
  spec.attribute("oiio:UnassociatedAlpha", 1);
  // The name only labels messages: the bytes go to memory.
  if (!output || !output->open(file.filename().string(), spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()) || !output->close())
    throw UserError("Cannot write the image " + file.string() + " (" +
                    (output ? output->geterror() : OIIO::geterror()) + "): try another format.");
  write_file_atomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Image read_image(const std::filesystem::path& file) {
  return to_image(decode_image(file, read_file(file, std::size_t{1} << 30), 1, kMaxPhotoSide).pixels);
}

}  // namespace patina
