#include "gui/crop_drag.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

int rounded(double value) { return static_cast<int>(std::lround(std::clamp(value, -1e6, 1e6))); }

}  // namespace

CropHandle crop_handle_at(const PhotoCrop& crop, double x, double y, double reach) {
  const double right = x - crop.x - crop.side, bottom = y - crop.y - crop.side;
  const bool at_left = std::abs(x - crop.x) <= reach, at_right = std::abs(right) <= reach;
  const bool at_top = std::abs(y - crop.y) <= reach, at_bottom = std::abs(bottom) <= reach;
  if (at_left && at_top) return CropHandle::top_left;
  if (at_right && at_top) return CropHandle::top_right;
  if (at_left && at_bottom) return CropHandle::bottom_left;
  if (at_right && at_bottom) return CropHandle::bottom_right;
  const bool inside = x >= crop.x && y >= crop.y && right <= 0 && bottom <= 0;
  return inside ? CropHandle::inside : CropHandle::none;
}

PhotoCrop dragged_crop(const PhotoCrop& start, CropHandle handle, double right, double down, int photo_width,
                       int photo_height) {
  if (handle == CropHandle::none) return start;
  if (handle == CropHandle::inside) {
    return {std::clamp(rounded(start.x + right), 0, photo_width - start.side),
            std::clamp(rounded(start.y + down), 0, photo_height - start.side), start.side};
  }
  const bool holds_left = handle == CropHandle::top_right || handle == CropHandle::bottom_right;
  const bool holds_top = handle == CropHandle::bottom_left || handle == CropHandle::bottom_right;
  const int held_x = holds_left ? start.x : start.x + start.side;
  const int held_y = holds_top ? start.y : start.y + start.side;
  // The mean of both directions: the corner follows the mouse along the diagonal.
  const double grown = 0.5 * ((holds_left ? right : -right) + (holds_top ? down : -down));
  const int room =
      std::min(holds_left ? photo_width - held_x : held_x, holds_top ? photo_height - held_y : held_y);
  const int side = std::clamp(rounded(start.side + grown), std::min(kMinPhotoSide, room), room);
  return {holds_left ? held_x : held_x - side, holds_top ? held_y : held_y - side, side};
}

PhotoCrop resized_crop(const PhotoCrop& crop, int grown, int photo_width, int photo_height) {
  const int most = std::min(photo_width, photo_height);
  const int side = std::clamp(crop.side + grown, std::min(kMinPhotoSide, most), most);
  const int shift = (crop.side - side) / 2;
  return {std::clamp(crop.x + shift, 0, photo_width - side),
          std::clamp(crop.y + shift, 0, photo_height - side), side};
}

}  // namespace patina
