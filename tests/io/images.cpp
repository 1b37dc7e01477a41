#include "tests/io/images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace patina {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

/// CRC-32 of ISO 3309, as PNG (second edition, annex D) has it.
std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const unsigned char byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
  }
  return ~crc;
}

std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32(type + data));
}

std::string jpeg_segment(int marker, const std::string& data) {
  const std::size_t length = data.size() + 2;
  return std::string{'\xFF', static_cast<char>(marker), static_cast<char>(length >> 8),
                     static_cast<char>(length)} +
         data;
}

/// Bits of a JPEG scan, with a zero stuffed after every FF.
class ScanBits {
 public:
  void put(unsigned value, int count) {
    while (count-- > 0) {
      byte_ = byte_ << 1 | (value >> count & 1);
      if (++filled_ == 8) flush();
    }
  }
  std::string finished() {
    while (filled_ != 0) put(1, 1);
    return bytes_;
  }

 private:
  void flush() {
    bytes_ += static_cast<char>(byte_);
    if (byte_ == 0xFF) bytes_ += '\0';
    byte_ = 0;
    filled_ = 0;
  }
  std::string bytes_;
  unsigned byte_ = 0;
  int filled_ = 0;
};

/// Twelve codes of four bits for the DC categories 0 to 11, and one of one bit for "end of block".
const std::string kDcTable = std::string("\x00\0\0\0\x0C\0\0\0\0\0\0\0\0\0\0\0\0", 17) +
                             std::string("\0\1\2\3\4\5\6\7\x8\x9\xA\xB", 12);
const std::string kAcTable = std::string("\x10\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 18);

/// With all quantisers 1 the DC coefficient of a flat block is eight times its sample, less 128.
void put_dc(ScanBits& bits, int difference) {
  const unsigned size = static_cast<unsigned>(std::abs(difference));
  int category = 0;
  while (size >> category) ++category;
  bits.put(static_cast<unsigned>(category), 4);
  bits.put(difference >= 0 ? size : static_cast<unsigned>(difference - 1) & ((1u << category) - 1), category);
  bits.put(0, 1);
}

}  // namespace

void write_test_image(const std::filesystem::path& file, const Image& image, const FileKind& kind) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, kind.type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  kind.adjust(spec);
  const auto output = OIIO::ImageOutput::create(file.string());
  if (!output || !output->open(file.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()) || !output->close())
    throw std::runtime_error("cannot write " + file.string() + ": " +
                             (output ? output->geterror() : OIIO::geterror()));
}

Image ramps(int width, int height, int channels) {
  Image image(width, height, channels);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      for (int c = 0; c < channels; ++c) {
        const float x = static_cast<float>(column) / static_cast<float>(width - 1);
        const float y = static_cast<float>(row) / static_cast<float>(height - 1);
        const float weight = static_cast<float>(c + 1) / static_cast<float>(channels + 1);
        image.at(row, column, c) = 0.1f + 0.8f * (weight * x + (1 - weight) * y);
      }
  return image;
}

Image uniform(int width, int height, const std::vector<float>& values) {
  Image image(width, height, static_cast<int>(values.size()));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = values[i % values.size()];
  return image;
}

float max_difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    return std::numeric_limits<float>::infinity();
  float largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const float difference = std::abs(a.pixels[i] - b.pixels[i]);
    if (std::isnan(difference)) return std::numeric_limits<float>::infinity();
    largest = std::max(largest, difference);
  }
  return largest;
}

Image crop(const Image& image, int left, int top, int side) {
  Image result(side, side, image.channels);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      for (int c = 0; c < image.channels; ++c)
        result.at(row, column, c) = image.at(top + row, left + column, c);
  return result;
}

std::string png_header(std::uint32_t width, std::uint32_t height) {
  const std::string eight_bit_rgb("\x08\x02\0\0\0", 5);
  return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", big_endian(width) + big_endian(height) + eight_bit_rgb) +
         png_chunk("IDAT", "") + png_chunk("IEND", "");
}

std::string with_png_checksums(std::string bytes) {
  if (!bytes.starts_with("\x89PNG")) return bytes;
  for (std::size_t position = 8; position + 12 <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      length = length << 8 | static_cast<unsigned char>(bytes[position + i]);
    if (position + 12 + length > bytes.size()) break;
    bytes.replace(position + 8 + length, 4, big_endian(crc32(bytes.substr(position + 4, 4 + length))));
    position += 12 + length;
  }
  return bytes;
}

std::string flat_jpeg(int width, int height, const std::vector<int>& components) {
  const auto count = static_cast<char>(components.size());
  std::string frame{'\x08',
                    static_cast<char>(height >> 8),
                    static_cast<char>(height),
                    static_cast<char>(width >> 8),
                    static_cast<char>(width),
                    count};
  std::string scan{count};
  for (char id = 1; id <= count; ++id) {
    frame += {id, '\x11', '\0'};
    scan += {id, '\0'};
  }
  ScanBits bits;
  const int blocks = (width + 7) / 8 * ((height + 7) / 8);
  for (int block = 0; block < blocks; ++block)
    for (const int sample : components) put_dc(bits, block == 0 ? 8 * (sample - 128) : 0);
  std::string jpeg = "\xFF\xD8";
  if (components.size() == 4) jpeg += jpeg_segment(0xEE, std::string("Adobe\0\x64\0\0\0\0\0", 12));
  return jpeg + jpeg_segment(0xDB, '\0' + std::string(64, '\1')) + jpeg_segment(0xC0, frame) +
         jpeg_segment(0xC4, kDcTable) + jpeg_segment(0xC4, kAcTable) +
         jpeg_segment(0xDA, scan + std::string("\0\x3F\0", 3)) + bits.finished() + "\xFF\xD9";
}

}  // namespace patina
