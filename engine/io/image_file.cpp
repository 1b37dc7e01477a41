#include "engine/io/image_file.h"

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <system_error>

#include "engine/error.h"

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

[[noreturn]] void refuse_write(const std::filesystem::path& file, const std::string& reason) {
  throw UserError(
      "Cannot write the image " + file.string() + " (" + reason +
      "): check that the folder exists, the disk is not full and the name ends in .png, .jpg, .tif or .exr.");
}

}  // namespace

void write_image(const std::filesystem::path& file, const Image& image, PixelDepth depth) {
  // The extension decides the format, so the temporary file keeps it.
  std::filesystem::path temporary = file;
  temporary.replace_filename("." + file.stem().string() + ".part" + file.extension().string());
  const auto output = OIIO::ImageOutput::create(temporary.string());
  if (!output) {
    OIIO::geterror();
    refuse_write(file, "unknown kind of image");
  }
  OIIO::ImageSpec spec(image.width, image.height, image.channels, type_of(depth));
  const bool written = output->open(temporary.string(), spec) &&
                       output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()) && output->close();
  std::error_code error;
  if (written) std::filesystem::rename(temporary, file, error);
  if (!written || error) {
    const std::string reason = error ? error.message() : output->geterror();
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    refuse_write(file, reason);
  }
}

Image read_image(const std::filesystem::path& file) {
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) {
    OIIO::geterror();
    throw UserError("Cannot read " + file.string() + " as an image: check the path, or save it as PNG.");
  }
  const OIIO::ImageSpec& spec = input->spec();
  Image image(spec.width, spec.height, spec.nchannels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
    throw UserError("The image " + file.string() + " is damaged: save or copy it again.");
  return image;
}

}  // namespace patina
