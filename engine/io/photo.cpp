#include "engine/io/photo.h"

#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "engine/io/decode.h"
#include "engine/io/file.h"

namespace patina {
namespace {

namespace fs = std::filesystem;

OIIO::ImageBuf central_square(const OIIO::ImageBuf& whole) {
  const int side = std::min(whole.spec().width, whole.spec().height);
  const int left = (whole.spec().width - side) / 2, top = (whole.spec().height - side) / 2;
  return OIIO::ImageBufAlgo::cut(whole, OIIO::ROI(left, left + side, top, top + side));
}

OIIO::ImageBuf resized_buffer(const OIIO::ImageBuf& source, int side) {
  const int channels = source.nchannels();
  OIIO::ImageBuf result(OIIO::ImageSpec(side, side, channels, OIIO::TypeDesc::FLOAT));
  OIIO::ImageBufAlgo::resize(result, source, "", 0, OIIO::ROI(0, side, 0, side, 0, 1, 0, channels));
  return result;
}

/// Makes every value a finite one in [0, 1], as a camera's sensor would: beyond white is white, and so is
/// infinity; NaN is black. Before any filter, which would spread them. @return pixels that had a value that
/// was not finite
int clip(Image& image) {
  int mended = 0;
  for (std::size_t begin = 0; begin < image.pixels.size();
       begin += static_cast<std::size_t>(image.channels)) {
    bool finite = true;
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(image.channels); ++i) {
      finite &= std::isfinite(image.pixels[i]);
      image.pixels[i] = image.pixels[i] > 0 ? std::min(image.pixels[i], 1.0f) : 0.0f;
    }
    mended += !finite;
  }
  return mended;
}

/// IEC 61966-2-1.
float encode_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

bool is_linear(const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  return OIIO::Strutil::istarts_with(space, "lin") || (space.empty() && spec.format.is_floating_point());
}

/// Three channels out of whatever there are; warnings say what was left out.
Image to_rgb(const Image& image, int alpha_channel, std::vector<std::string>& warnings) {
  const int colours = alpha_channel >= 0 ? alpha_channel : image.channels;
  if (colours == 2 || colours > 3)
    warnings.push_back("The photo has " + std::to_string(colours) + " channels: only the first " +
                       (colours > 3 ? "three are" : "one is") + " used.");
  Image rgb(image.width, image.height, 3);
  bool see_through = false;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      if (alpha_channel >= 0) see_through |= image.at(row, column, alpha_channel) < 0.999f;
      for (int c = 0; c < 3; ++c) rgb.at(row, column, c) = image.at(row, column, colours >= 3 ? c : 0);
    }
  if (see_through) warnings.push_back("The photo has transparent parts: their transparency is ignored.");
  return rgb;
}

/// Display values of the square, at most kWorkingPhotoSide a side, not yet upright.
Image display_square(const DecodedImage& decoded, std::vector<std::string>& warnings) {
  const OIIO::ImageBuf square = central_square(decoded.pixels);
  const bool is_float = decoded.header.format.is_floating_point();
  const bool is_large = square.spec().width > kWorkingPhotoSide;
  // Integers cannot be out of range, and reducing them first keeps a large photo's floats out of memory.
  Image native = to_image(is_large && !is_float ? resized_buffer(square, kWorkingPhotoSide) : square);
  if (const int mended = clip(native); mended > 0 && is_float)
    warnings.push_back(
        "The photo has " + std::to_string(mended) +
        " pixels that are not numbers: infinite ones were taken as white, the others as black.");
  Image rgb = to_rgb(native, decoded.header.alpha_channel, warnings);
  rgb = resized(rgb, std::min(rgb.width, kWorkingPhotoSide));
  if (is_linear(decoded.header)) std::ranges::transform(rgb.pixels, rgb.pixels.begin(), encode_srgb);
  return rgb;
}

/// The EXIF orientation (1 to 8) to undo.
int orientation_of(const DecodedImage& decoded) {
  const int orientation = decoded.header.get_int_attribute("Orientation", 1);
  return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

/// Undoes an orientation. Not by OpenImageIO's reorient(): in 2.4.7 it takes 5 and 7 for each other.
Image upright(const Image& image, int orientation) {
  using namespace OIIO::ImageBufAlgo;
  if (orientation == 1) return image;
  OIIO::ImageBuf buffer = to_buffer(image);
  if (orientation >= 5) buffer = transpose(buffer);  // first, then as a turn or mirror of what that gives
  switch (orientation) {
    case 2:
    case 6:
      return to_image(flop(buffer));
    case 3:
    case 7:
      return to_image(rotate180(buffer));
    case 4:
    case 8:
      return to_image(flip(buffer));
    default:
      return to_image(buffer);
  }
}

Photo photo_of(const DecodedImage& decoded) {
  const int orientation = orientation_of(decoded);
  Photo photo;
  photo.original_width = decoded.header.width;
  photo.original_height = decoded.header.height;
  if (orientation >= 5) std::swap(photo.original_width, photo.original_height);
  if (decoded.cmyk)
    photo.warnings.push_back("The photo is CMYK: its colours were converted without its print profile.");
  photo.image = upright(display_square(decoded, photo.warnings), orientation);
  return photo;
}

}  // namespace

Photo load_photo(const fs::path& file) {
  constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
  try {
    const std::string bytes = read_file(file, kMaxFileBytes);
    Photo photo = photo_of(decode_image(file, bytes, kMinPhotoSide, kMaxPhotoSide));
    photo.sha256 = sha256_hex(bytes);
    return photo;
  } catch (const std::bad_alloc&) {
    refuse_image(file, "needs more memory than there is: reduce its size.");
  }
}

Image resized(const Image& image, int side) {
  if (image.width == side && image.height == side) return image;
  Image result = to_image(resized_buffer(to_buffer(image), side));
  for (float& value : result.pixels) value = std::clamp(value, 0.0f, 1.0f);  // Lanczos rings beyond the range
  return result;
}

}  // namespace patina
