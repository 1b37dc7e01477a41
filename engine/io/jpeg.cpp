#include "engine/io/jpeg.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cassert>
#include <stdexcept>
#include <string>
#include <vector>

namespace patina {
namespace {

constexpr const char* kName = "memory.jpg";  // only labels messages

std::vector<unsigned char> encode(const Image& image, int quality) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("jpeg", &memory);
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:" + std::to_string(quality));
  if (!output || !output->open(kName, spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()) || !output->close())
    throw std::runtime_error("an image cannot be stored as JPEG: " +
                             (output ? output->geterror() : OIIO::geterror()));
  return bytes;
}

}  // namespace

Image through_jpeg(const Image& image, int quality) {
  assert(image.channels == 3 && quality >= 1 && quality <= 100);
  std::vector<unsigned char> bytes = encode(image, quality);
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const auto input = OIIO::ImageInput::open(kName, nullptr, &memory);
  Image result(image.width, image.height, image.channels);
  if (!input || !input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::FLOAT, result.pixels.data()))
    throw std::runtime_error("a JPEG in memory cannot be read: " +
                             (input ? input->geterror() : OIIO::geterror()));
  return result;
}

}  // namespace patina
