#include "engine/run/run_photo.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/io/image_file.h"
#include "engine/run/manifest.h"
#include "engine/run/run_files.h"

namespace patina {

Image as_kept(Image image) {
  constexpr float kSteps = 65535, kStep = 1 / kSteps;  // times a step, as OpenImageIO reads
  for (float& value : image.pixels) value = std::round(std::clamp(value, 0.0f, 1.0f) * kSteps) * kStep;
  return image;
}

Image read_run_photo(const std::filesystem::path& directory) {
  Image photo = read_image(photo_file(directory));
  if (photo.channels != 3 || photo.width != photo.height)
    throw UserError(photo_file(directory).string() +
                    " is not the square photo of a run: restore it from a copy, or start a new run.");
  return photo;
}

Photo photo_of_run(const std::filesystem::path& directory) {
  const Manifest manifest = read_manifest(directory);
  Photo photo;
  photo.image = read_run_photo(directory);
  photo.crop = manifest.crop.value_or(central_crop(manifest.photo_width, manifest.photo_height));
  photo.original_width = manifest.photo_width;
  photo.original_height = manifest.photo_height;
  photo.sha256 = manifest.photo_sha256;
  photo.warnings = manifest.photo_warnings;
  return photo;
}

}  // namespace patina
