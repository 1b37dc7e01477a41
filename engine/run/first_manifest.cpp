#include "engine/run/first_manifest.h"

#include "engine/posterior/posterior.h"
#include "engine/run/network_checksum.h"
#include "engine/run/version.h"

namespace patina {

Manifest first_manifest(const RunSettings& settings, const Photo& photo, const ParameterTable& table) {
  Manifest manifest;
  manifest.program = program_version();
  manifest.settings = settings;
  manifest.table = table;
  manifest.photo_sha256 = photo.sha256;
  manifest.photo_width = photo.original_width;
  manifest.photo_height = photo.original_height;
  // An image that did not come from a file has no crop.
  const bool chosen =
      photo.crop.side > 0 && photo.crop != central_crop(photo.original_width, photo.original_height);
  if (chosen) manifest.crop = photo.crop;
  manifest.photo_warnings = photo.warnings;
  manifest.network_sha256 = network_checksum(settings.network);
  const PosteriorSettings posterior;
  manifest.gram_sigma = posterior.gram_sigma;
  manifest.mean_sigma = posterior.mean_sigma;
  manifest.phase = RunPhase::searching;
  return manifest;
}

}  // namespace patina
