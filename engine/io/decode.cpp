#include "engine/io/decode.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <new>

#include "engine/error.h"
#include "engine/io/image_format.h"

namespace patina {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxPixels = 128'000'000;
constexpr std::uint64_t kMaxDecodedBytes = std::uint64_t{1} << 30;

// Deflate reaches 1032:1 on a single colour and no photo comes near it, so that more is a lie or a bomb.
// Small images cost nothing to try.
constexpr std::uint64_t kMaxCompression = 5000;
constexpr std::uint64_t kHarmlessBytes = std::uint64_t{64} << 20;

std::string size_text(const OIIO::ImageSpec& spec) {
  return std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
}

void check_header(const fs::path& file, const OIIO::ImageSpec& spec, int min_side, int max_side) {
  if (std::min(spec.width, spec.height) < min_side)
    refuse_image(file, "has " + size_text(spec) + ", too few to show a material: use one of at least " +
                           std::to_string(min_side) + " pixels a side.");
  if (std::max(spec.width, spec.height) > max_side)
    refuse_image(file, "has " + size_text(spec) + ", too many: reduce it to at most " +
                           std::to_string(max_side) + " pixels a side.");
  if (std::int64_t{spec.width} * spec.height > kMaxPixels || spec.image_bytes(true) > kMaxDecodedBytes)
    refuse_image(file, "has " + size_text(spec) + ", too many: reduce it to at most " +
                           std::to_string(kMaxPixels / 1'000'000) + " megapixels.");
  const bool sane_tiles = spec.tile_width <= max_side && spec.tile_height <= max_side &&
                          spec.tile_bytes(true) <= kMaxDecodedBytes;
  if (spec.depth > 1 || spec.deep || spec.nchannels < 1 || spec.nchannels > 64 || !sane_tiles)
    refuse_image(file, "is not a flat image: save it as PNG or JPEG.");
  // OpenImageIO 2.4 inverts more bytes than such a TIFF has: it writes beyond its buffer.
  if (spec.get_int_attribute("tiff:PhotometricInterpretation", 1) == 0)
    refuse_image(file, "is a TIFF with white stored as zero, which cannot be read: save it as PNG.");
}

void check_compression(const fs::path& file, const OIIO::ImageSpec& spec, std::size_t file_bytes) {
  const std::uint64_t decoded = spec.image_bytes(true);
  if (decoded > kHarmlessBytes && decoded / kMaxCompression > file_bytes)
    refuse_image(file, "is damaged or no photo, for its " + std::to_string(file_bytes) +
                           " bytes are too few for " + size_text(spec) + ": copy or save it again.");
}

std::unique_ptr<OIIO::ImageInput> open_image(const fs::path& file, const std::string& format,
                                             OIIO::ImageSpec& header) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, not multiplied by alpha
  auto input = OIIO::ImageInput::create(format);
  if (!input || !input->open(file.string(), header, config)) {
    OIIO::geterror();
    if (input) input->geterror();
    refuse_image(file, "is damaged or of a kind that cannot be read: save it as PNG or JPEG.");
  }
  return input;
}

OIIO::ImageBuf read_pixels(const fs::path& file, OIIO::ImageInput& input, const OIIO::ImageSpec& header) {
  OIIO::ImageSpec spec(header.width, header.height, header.nchannels, header.format);
  spec.alpha_channel = header.alpha_channel;
  OIIO::ImageBuf pixels(spec);
  if (!pixels.localpixels()) throw std::bad_alloc();
  // "As stored" goes straight into place; any named type costs a detour through 64 MiB of scratch.
  const OIIO::TypeDesc as_stored;
  const OIIO::TypeDesc type = header.channelformats.empty() ? as_stored : header.format;
  const bool whole = input.read_image(0, 0, 0, header.nchannels, type, pixels.localpixels());
  // Some readers fill what is missing and only leave a message.
  if (const std::string message = input.geterror(); !whole || !message.empty())
    refuse_image(
        file, "is damaged or incomplete (" + size_text(header) + " were promised): copy or save it again.");
  return pixels;
}

}  // namespace

void refuse_image(const fs::path& file, const std::string& why_and_cure) {
  throw UserError("The image " + file.filename().string() + " " + why_and_cure);
}

DecodedImage decode_image(const fs::path& file, std::string_view bytes, int min_side, int max_side) {
  if (bytes.empty()) refuse_image(file, "is empty: copy it again.");
  if (is_camera_raw(file))
    refuse_image(file, "is a camera's raw file: develop it to a 16-bit TIFF or a JPEG first.");
  DecodedImage image;
  image.format = image_format(bytes);
  // OpenImageIO 2.4 reads beyond its buffer where a damaged file's sizes contradict each other.
  if (image.format == "heif")
    refuse_image(file, "is HEIC or AVIF, which cannot be read yet: save it as JPEG or PNG.");
  if (image.format.empty())
    refuse_image(file, "is not an image that can be read: save it as JPEG, PNG, TIFF or EXR.");
  if (!image_is_complete(bytes)) refuse_image(file, "is incomplete, its end is missing: copy it again.");
  try {
    const auto input = open_image(file, image.format, image.header);
    check_header(file, image.header, min_side, max_side);
    check_compression(file, image.header, bytes.size());
    image.cmyk = image.format == "jpeg" ? jpeg_components(bytes) == 4
                                        : image.header.get_string_attribute("tiff:ColorSpace") == "CMYK";
    image.pixels = read_pixels(file, *input, image.header);
    return image;
  } catch (const UserError&) {
    throw;
  } catch (const std::bad_alloc&) {
    refuse_image(file, "needs more memory than there is: reduce its size.");
  } catch (const std::exception&) {  // decoders behind OpenImageIO throw what they like
    refuse_image(file, "is damaged: copy or save it again.");
  }
}

Image to_image(const OIIO::ImageBuf& buffer) {
  if (!buffer.localpixels()) throw std::bad_alloc();
  const OIIO::ImageSpec& spec = buffer.spec();
  Image image(spec.width, spec.height, spec.nchannels);
  buffer.get_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, image.pixels.data());
  return image;
}

OIIO::ImageBuf to_buffer(const Image& image) {
  OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT));
  buffer.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, image.pixels.data());
  return buffer;
}

}  // namespace patina
