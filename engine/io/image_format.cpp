#include "engine/io/image_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

namespace patina {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::size_t offset;
  std::string_view bytes;
  const char* format;
};

constexpr std::array kSignatures{
    Signature{0, "\xFF\xD8\xFF"sv, "jpeg"},
    Signature{0, "\x89PNG\r\n\x1A\n"sv, "png"},
    Signature{0, "II*\0"sv, "tiff"},
    Signature{0, "MM\0*"sv, "tiff"},
    Signature{0, "II+\0"sv, "tiff"},
    Signature{0, "MM\0+"sv, "tiff"},
    Signature{0, "\x76\x2F\x31\x01"sv, "openexr"},
    Signature{8, "WEBPVP8"sv, "webp"},
    Signature{4, "ftypheic"sv, "heif"},
    Signature{4, "ftypheix"sv, "heif"},
    Signature{4, "ftypmif1"sv, "heif"},
    Signature{4, "ftypavif"sv, "heif"},
    Signature{0, "\0\0\0\x0CjP  "sv, "jpeg2000"},
    Signature{0, "\xFF\x4F\xFF\x51"sv, "jpeg2000"},
    Signature{0, "#?RADIANCE"sv, "hdr"},
    Signature{0, "#?RGBE"sv, "hdr"},
    Signature{0, "BM"sv, "bmp"},
    Signature{0, "P5"sv, "pnm"},
    Signature{0, "P6"sv, "pnm"},
};

constexpr std::array kRawExtensions{".dng"sv, ".nef"sv, ".cr2"sv, ".cr3"sv, ".arw"sv, ".raf"sv,
                                    ".orf"sv, ".rw2"sv, ".pef"sv, ".srw"sv, ".raw"sv};

/// A JPEG's segments, one after another.
class JpegWalk {
 public:
  static constexpr int kEndOfImage = 0xD9, kStartOfScan = 0xDA;

  explicit JpegWalk(std::string_view bytes) : bytes_(bytes) {}

  /// The next marker that has a meaning here, or -1 at the end of the bytes; afterwards payload() is its
  /// segment's.
  int next() {
    payload_ = {};
    while (position_ + 1 < bytes_.size()) {
      const int marker = byte(position_ + 1);
      // Entropy-coded data: 00 is a stuffed byte, D0..D7 restart, FF pads; none starts a segment.
      if (byte(position_) != 0xFF || marker == 0 || marker == 0xFF || (marker >= 0xD0 && marker <= 0xD8)) {
        ++position_;
        continue;
      }
      position_ += 2;
      if (marker == kEndOfImage || marker == 0x01) return marker;
      return enter_segment() ? marker : -1;
    }
    return -1;
  }

  std::string_view payload() const { return payload_; }

 private:
  int byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }

  bool enter_segment() {
    if (position_ + 2 > bytes_.size()) return false;
    const auto length = static_cast<std::size_t>(byte(position_) << 8 | byte(position_ + 1));
    if (length < 2 || position_ + length > bytes_.size()) return false;
    payload_ = bytes_.substr(position_ + 2, length - 2);
    position_ += length;
    return true;
  }

  std::string_view bytes_, payload_;
  std::size_t position_ = 2;  ///< behind the start-of-image marker
};

bool is_frame_header(int marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool jpeg_is_complete(std::string_view bytes) {
  JpegWalk walk(bytes);
  bool scanned = false;
  for (int marker = walk.next(); marker >= 0; marker = walk.next()) {
    if (marker == JpegWalk::kEndOfImage) return scanned;
    scanned |= marker == JpegWalk::kStartOfScan;
  }
  return false;
}

std::uint64_t big_endian(std::string_view four_bytes) {
  std::uint64_t value = 0;
  for (const unsigned char byte : four_bytes) value = value << 8 | byte;
  return value;
}

bool png_is_complete(std::string_view bytes) {
  constexpr std::uint64_t kSignature = 8, kFrame = 12;  // of a chunk: length, type and CRC
  for (std::uint64_t position = kSignature; position + kFrame <= bytes.size();) {
    const std::string_view type = bytes.substr(position + 4, 4);
    position += kFrame + big_endian(bytes.substr(position, 4));
    if (type == "IEND") return position <= bytes.size();
  }
  return false;
}

bool webp_is_complete(std::string_view bytes) {
  std::string size(bytes.substr(4, 4));
  std::ranges::reverse(size);
  return 8 + big_endian(size) <= bytes.size();
}

}  // namespace

std::string image_format(std::string_view bytes) {
  for (const Signature& signature : kSignatures)
    if (bytes.size() > signature.offset && bytes.substr(signature.offset).starts_with(signature.bytes))
      return signature.format;
  return {};
}

bool is_camera_raw(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::find(kRawExtensions, extension) != kRawExtensions.end();
}

bool image_is_complete(std::string_view bytes) {
  const std::string format = image_format(bytes);
  if (format == "jpeg") return jpeg_is_complete(bytes);
  if (format == "png") return png_is_complete(bytes);
  if (format == "webp") return webp_is_complete(bytes);
  return true;
}

int jpeg_components(std::string_view bytes) {
  JpegWalk walk(bytes);
  for (int marker = walk.next(); marker >= 0; marker = walk.next())
    if (is_frame_header(marker) && walk.payload().size() >= 6)
      return static_cast<unsigned char>(walk.payload()[5]);
  return 0;
}

}  // namespace patina
