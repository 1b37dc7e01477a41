#pragma once

#include <filesystem>

#include "engine/io/photo.h"

namespace patina {

// A run's own copy of its photo, photo.png, from which it can be gone on with where the file that was given
// is gone.

/// The image as photo.png keeps it, in steps of 1/65535: what a run infers from, so that it is the same when
/// the copy is read.
Image as_kept(Image image);

/// @throws UserError for one that is missing, damaged or not a square of three channels
Image read_run_photo(const std::filesystem::path& directory);

/// The photo that a run was made with, as far as the run depends on it. @throws UserError as read_manifest()
/// does, too
Photo photo_of_run(const std::filesystem::path& directory);

}  // namespace patina
