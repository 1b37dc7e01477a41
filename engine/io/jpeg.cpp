#include "engine/io/jpeg.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <string>
#include <vector>

namespace patina {
namespace {

constexpr const char* kName = "memory.jpg";  // only labels messages

// Conversions are done here: OpenImageIO hands every row of them to its pool of threads, which for so few
// pixels takes longer than the rest of a JPEG.
std::vector<unsigned char> to_bytes(const Image& image) {
  std::vector<unsigned char> bytes(image.pixels.size());
  std::ranges::transform(image.pixels, bytes.begin(), [](float value) {
    return static_cast<unsigned char>(255 * std::clamp(value, 0.0f, 1.0f) + 0.5f);
  });
  return bytes;
}

std::vector<unsigned char> encode(const Image& image, int quality) {
  const std::vector<unsigned char> pixels = to_bytes(image);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("jpeg", &memory);
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:" + std::to_string(quality));
  if (!output || !output->open(kName, spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) ||
      !output->close())
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
  std::vector<unsigned char> pixels(image.pixels.size());
  if (!input || !input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::UINT8, pixels.data()))
    throw std::runtime_error("a JPEG in memory cannot be read: " +
                             (input ? input->geterror() : OIIO::geterror()));
  Image result(image.width, image.height, image.channels);
  std::ranges::transform(pixels, result.pixels.begin(),
                         [](unsigned char value) { return static_cast<float>(value) / 255; });
  return result;
}

}  // namespace patina
