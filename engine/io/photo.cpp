#include "engine/io/photo.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxPixels = 128'000'000;

[[noreturn]] void refuse(const fs::path& file, const std::string& why_and_cure) {
  throw UserError("The photo " + file.filename().string() + " " + why_and_cure);
}

/// A JPEG whose last scan has no end-of-image marker behind it was cut off. libjpeg would paint the rest grey
/// and only warn. Entropy-coded data cannot contain either marker, and a thumbnail's pair precedes the scan.
bool is_cut_jpeg(const std::string& bytes) {
  if (!bytes.starts_with("\xFF\xD8")) return false;
  const auto last_scan = bytes.rfind("\xFF\xDA");
  const auto last_end = bytes.rfind("\xFF\xD9");
  return last_end == std::string::npos || (last_scan != std::string::npos && last_end < last_scan);
}

void check_size(const fs::path& file, const OIIO::ImageSpec& spec) {
  const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
  if (std::min(spec.width, spec.height) < kMinPhotoSide)
    refuse(file, "has " + size + ", too few to show a material: use one of at least " +
                     std::to_string(kMinPhotoSide) + " pixels a side.");
  if (std::max(spec.width, spec.height) > kMaxPhotoSide)
    refuse(file, "has " + size + ", too many: reduce it to at most " + std::to_string(kMaxPhotoSide) +
                     " pixels a side.");
  if (std::int64_t{spec.width} * spec.height > kMaxPixels)
    refuse(file, "has " + size + ", too many: reduce it to at most " +
                     std::to_string(kMaxPixels / 1'000'000) + " megapixels.");
  if (spec.depth > 1 || spec.deep || spec.nchannels < 1 || spec.nchannels > 64)
    refuse(file, "is not a flat image: save it as PNG or JPEG.");
}

OIIO::ImageSpec read_header(const fs::path& file, const OIIO::ImageSpec& config) {
  const auto input = OIIO::ImageInput::open(file.string(), &config);
  if (!input) {
    OIIO::geterror();
    refuse(file, "is not an image that can be read: save it as JPEG, PNG, TIFF or EXR.");
  }
  return input->spec();
}

/// The central square at its native resolution and type, as stored (orientation not yet applied).
OIIO::ImageBuf read_central_square(const fs::path& file, const OIIO::ImageSpec& config) {
  const OIIO::ImageSpec header = read_header(file, config);
  check_size(file, header);
  OIIO::ImageBuf whole(file.string(), 0, 0, nullptr, &config);
  if (!whole.read(0, 0, /*force=*/true) || whole.has_error())
    refuse(file, "is damaged or incomplete (" + std::to_string(header.width) + " x " +
                     std::to_string(header.height) + " pixels were promised): copy or save it again.");
  const int side = std::min(header.width, header.height);
  const int left = header.x + (header.width - side) / 2, top = header.y + (header.height - side) / 2;
  OIIO::ImageBuf square = OIIO::ImageBufAlgo::cut(whole, OIIO::ROI(left, left + side, top, top + side));
  if (square.has_error()) refuse(file, "could not be cropped: save it as PNG.");
  return square;
}

Image to_image(const OIIO::ImageBuf& buffer) {
  const OIIO::ImageSpec& spec = buffer.spec();
  Image image(spec.width, spec.height, spec.nchannels);
  buffer.get_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, image.pixels.data());
  return image;
}

OIIO::ImageBuf resized_buffer(const OIIO::ImageBuf& source, int side) {
  const int channels = source.nchannels();
  OIIO::ImageBuf result(OIIO::ImageSpec(side, side, channels, OIIO::TypeDesc::FLOAT));
  OIIO::ImageBufAlgo::resize(result, source, "", 0, OIIO::ROI(0, side, 0, side, 0, 1, 0, channels));
  return result;
}

/// Replaces what is not a number, so that filters and statistics stay finite; returns how many pixels had
/// any.
int mend_non_finite(Image& image) {
  int mended = 0;
  for (std::size_t begin = 0; begin < image.pixels.size();
       begin += static_cast<std::size_t>(image.channels)) {
    bool bad = false;
    for (int c = 0; c < image.channels; ++c) {
      float& value = image.pixels[begin + static_cast<std::size_t>(c)];
      if (std::isfinite(value)) continue;
      value =
          value > 0 ? 1.0f : 0.0f;  // +infinity is a clipped highlight; NaN compares false and becomes black
      bad = true;
    }
    mended += bad;
  }
  return mended;
}

float encode_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

bool is_linear(const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  return OIIO::Strutil::istarts_with(space, "lin") || (space.empty() && spec.format.is_floating_point());
}

bool is_cmyk(const OIIO::ImageSpec& spec) {
  return spec.nchannels >= 4 && !spec.channelnames.empty() && spec.channelnames[0] == "C" &&
         spec.channelnames[3] == "K";
}

/// Three channels out of whatever there are; warnings say what was left out.
Image to_rgb(const Image& image, const OIIO::ImageSpec& spec, std::vector<std::string>& warnings) {
  const bool cmyk = is_cmyk(spec);
  if (cmyk) warnings.push_back("The photo is CMYK: its colours were converted without its print profile.");
  const int colours = spec.alpha_channel >= 0 ? spec.alpha_channel : spec.nchannels;
  if (!cmyk && colours > 3)
    warnings.push_back("The photo has more than three channels: the first three are used.");
  Image rgb(image.width, image.height, 3);
  bool see_through = false;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      if (spec.alpha_channel >= 0) see_through |= image.at(row, column, spec.alpha_channel) < 0.999f;
      for (int c = 0; c < 3; ++c)
        rgb.at(row, column, c) = cmyk ? (1 - image.at(row, column, c)) * (1 - image.at(row, column, 3))
                                      : image.at(row, column, colours >= 3 ? c : 0);
    }
  if (see_through) warnings.push_back("The photo has transparent parts: their transparency is ignored.");
  return rgb;
}

void to_display(Image& image, bool linear) {
  for (float& value : image.pixels)
    value = std::clamp(linear ? encode_srgb(std::max(value, 0.0f)) : value, 0.0f, 1.0f);
}

OIIO::ImageBuf from_image(const Image& image) {
  OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT));
  buffer.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, image.pixels.data());
  return buffer;
}

Image upright(const Image& image, int orientation) {
  if (orientation <= 1 || orientation > 8) return image;
  OIIO::ImageBuf buffer = from_image(image);
  buffer.specmod().attribute("Orientation", orientation);
  return to_image(OIIO::ImageBufAlgo::reorient(buffer));
}

Photo decode(const fs::path& file) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, not multiplied by alpha
  const OIIO::ImageBuf square = read_central_square(file, config);
  const OIIO::ImageSpec& spec = square.spec();
  const OIIO::ImageSpec header = read_header(file, config);
  const int orientation = header.get_int_attribute("Orientation", 1);

  Photo photo;
  photo.original_width = orientation >= 5 && orientation <= 8 ? header.height : header.width;
  photo.original_height = orientation >= 5 && orientation <= 8 ? header.width : header.height;
  Image native = spec.format.is_floating_point() || spec.width <= kWorkingPhotoSide
                     ? to_image(square)
                     : to_image(resized_buffer(square, kWorkingPhotoSide));
  if (const int mended = mend_non_finite(native))
    photo.warnings.push_back(
        "The photo has " + std::to_string(mended) +
        " pixels that are not numbers: infinite ones were taken as white, the others as black.");
  Image rgb = to_rgb(native, header, photo.warnings);
  if (rgb.width > kWorkingPhotoSide) rgb = to_image(resized_buffer(from_image(rgb), kWorkingPhotoSide));
  to_display(rgb, is_linear(header));
  photo.image = upright(rgb, orientation);
  return photo;
}

}  // namespace

Photo load_photo(const fs::path& file) {
  constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
  const std::string bytes = read_file(file, kMaxFileBytes);
  if (bytes.empty()) refuse(file, "is empty: copy it again.");
  if (is_cut_jpeg(bytes)) refuse(file, "is incomplete, its end is missing: copy it again.");
  try {
    Photo photo = decode(file);
    photo.sha256 = sha256_hex(bytes);
    return photo;
  } catch (const UserError&) {
    throw;
  } catch (const std::bad_alloc&) {
    refuse(file, "needs more memory than there is: reduce its size.");
  } catch (const std::exception&) {  // decoders behind OpenImageIO throw what they like
    refuse(file, "is damaged: copy or save it again.");
  }
}

Image resized(const Image& image, int side) {
  if (image.width == side && image.height == side) return image;
  Image result = to_image(resized_buffer(from_image(image), side));
  for (float& value : result.pixels) value = std::clamp(value, 0.0f, 1.0f);  // Lanczos rings beyond the range
  return result;
}

}  // namespace patina
