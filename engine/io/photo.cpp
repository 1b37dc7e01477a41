#include "engine/io/photo.h"

#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>

#include "engine/io/decode.h"
#include "engine/io/file.h"

namespace patina {
namespace {

namespace fs = std::filesystem;

/// Where the pixels of an upright crop are stored. @param width,height  of the photo as stored
OIIO::ROI stored_place(const PhotoCrop& crop, int orientation, int width, int height) {
  // EXIF 2.32, tag 274: which upright direction the stored columns and rows follow.
  const bool swaps = orientation >= 5;
  const bool columns_back = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool rows_back = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const int along_columns = swaps ? crop.y : crop.x, along_rows = swaps ? crop.x : crop.y;
  const int left = columns_back ? width - along_columns - crop.side : along_columns;
  const int top = rows_back ? height - along_rows - crop.side : along_rows;
  return {left, left + crop.side, top, top + crop.side};
}

OIIO::ImageBuf resized_buffer(const OIIO::ImageBuf& source, int width, int height) {
  const int channels = source.nchannels();
  OIIO::ImageBuf result(OIIO::ImageSpec(width, height, channels, OIIO::TypeDesc::FLOAT));
  // To hand few pixels to a pool of threads takes longer than to scale them.
  constexpr OIIO::imagesize_t kFew = 1 << 20;
  const int threads = source.spec().image_pixels() <= kFew ? 1 : 0;
  OIIO::ImageBufAlgo::resize(result, source, "", 0, OIIO::ROI(0, width, 0, height, 0, 1, 0, channels),
                             threads);
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

/// Display values of a part, its longer side at most `most` pixels, not yet upright.
Image display_part(const DecodedImage& decoded, const OIIO::ImageBuf& part, int most,
                   std::vector<std::string>& warnings) {
  const bool is_float = decoded.header.format.is_floating_point();
  const int longer = std::max(part.spec().width, part.spec().height);
  const auto reduced = [&](int length) {
    return longer > most ? std::max(1, static_cast<int>(std::int64_t{length} * most / longer)) : length;
  };
  const int width = reduced(part.spec().width), height = reduced(part.spec().height);
  // Integers cannot be out of range, and reducing them first keeps a large photo's floats out of memory.
  Image native = to_image(longer > most && !is_float ? resized_buffer(part, width, height) : part);
  if (const int mended = clip(native); mended > 0 && is_float)
    warnings.push_back(
        "The photo has " + std::to_string(mended) +
        " pixels that are not numbers: infinite ones were taken as white, the others as black.");
  Image rgb = to_rgb(native, decoded.header.alpha_channel, warnings);
  rgb = resized(rgb, width, height);
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

/// As computed from the 35 mm equivalent, whose frame is 36 x 24 mm.
std::optional<double> focal_pixels(const DecodedImage& decoded) {
  const int equivalent = decoded.header.get_int_attribute("Exif:FocalLengthIn35mmFilm", 0);
  if (equivalent < 4 || equivalent > 2000) return std::nullopt;
  return equivalent * std::hypot(decoded.header.width, decoded.header.height) / std::hypot(36, 24);
}

void check_crop(const fs::path& file, const PhotoCrop& crop, const Photo& photo) {
  if (crop.side < kMinPhotoSide)
    refuse_image(file, "cannot be cropped to " + std::to_string(crop.side) +
                           " pixels a side: take at least " + std::to_string(kMinPhotoSide) + ".");
  if (crop.x < 0 || crop.y < 0 || crop.side > photo.original_width - crop.x ||
      crop.side > photo.original_height - crop.y)
    refuse_image(file, "has " + std::to_string(photo.original_width) + " x " +
                           std::to_string(photo.original_height) + " pixels: the crop " +
                           std::to_string(crop.x) + "," + std::to_string(crop.y) + "," +
                           std::to_string(crop.side) + " (x, y, side) does not lie inside it.");
}

Photo photo_of(const fs::path& file, const DecodedImage& decoded, const PhotoOptions& options) {
  const int orientation = orientation_of(decoded);
  Photo photo;
  photo.original_width = decoded.header.width;
  photo.original_height = decoded.header.height;
  if (orientation >= 5) std::swap(photo.original_width, photo.original_height);
  if (decoded.cmyk)
    photo.warnings.push_back("The photo is CMYK: its colours were converted without its print profile.");
  photo.crop = options.crop.value_or(central_crop(photo.original_width, photo.original_height));
  check_crop(file, photo.crop, photo);
  photo.focal_pixels = focal_pixels(decoded);
  const OIIO::ROI place = stored_place(photo.crop, orientation, decoded.header.width, decoded.header.height);
  const OIIO::ImageBuf square = OIIO::ImageBufAlgo::cut(decoded.pixels, place);
  photo.image = upright(display_part(decoded, square, kWorkingPhotoSide, photo.warnings), orientation);
  std::vector<std::string> said_already;
  if (options.whole_side > 0)
    photo.whole =
        upright(display_part(decoded, decoded.pixels, options.whole_side, said_already), orientation);
  return photo;
}

}  // namespace

PhotoCrop central_crop(int width, int height) {
  const int side = std::min(width, height);
  return {(width - side) / 2, (height - side) / 2, side};
}

Photo load_photo(const fs::path& file, const PhotoOptions& options) {
  constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
  try {
    const std::string bytes = read_file(file, kMaxFileBytes);
    Photo photo = photo_of(file, decode_image(file, bytes, kMinPhotoSide, kMaxPhotoSide), options);
    photo.sha256 = sha256_hex(bytes);
    return photo;
  } catch (const std::bad_alloc&) {
    refuse_image(file, "needs more memory than there is: reduce its size.");
  }
}

Image resized(const Image& image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  Image result = to_image(resized_buffer(to_buffer(image), width, height));
  for (float& value : result.pixels) value = std::clamp(value, 0.0f, 1.0f);  // Lanczos rings beyond the range
  return result;
}

Image resized(const Image& image, int side) { return resized(image, side, side); }

}  // namespace patina
