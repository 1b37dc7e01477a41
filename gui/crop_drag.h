#pragma once

#include "engine/io/photo.h"

namespace patina {

/// What of a crop square is dragged.
enum class CropHandle { none, inside, top_left, top_right, bottom_left, bottom_right };

/// What lies under a point of the photo. @param reach  how near a corner counts, all in photo pixels
CropHandle crop_handle_at(const PhotoCrop& crop, double x, double y, double reach);

/// The square after a drag: moved whole, or with the corner opposite to the handle held. It stays inside the
/// photo and large enough to be used.
/// @param right,down  how far the mouse moved since the drag began with `start`, photo pixels
PhotoCrop dragged_crop(const PhotoCrop& start, CropHandle handle, double right, double down, int photo_width,
                       int photo_height);

/// The square about the same middle, its side grown by so many photo pixels; it stays inside the photo and
/// large enough to be used.
PhotoCrop resized_crop(const PhotoCrop& crop, int grown, int photo_width, int photo_height);

}  // namespace patina
