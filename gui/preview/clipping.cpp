#include "gui/preview/clipping.h"

#include <algorithm>

namespace patina {
namespace {

// A photo that was reduced or saved as JPEG keeps few pixels at white itself.
constexpr float kWhite = 253.5f / 255;
constexpr int kStripe = 6;  // pixels

bool is_clipped(const Image& photo, int row, int column) {
  return std::max({photo.at(row, column, 0), photo.at(row, column, 1), photo.at(row, column, 2)}) >= kWhite;
}

}  // namespace

Image clipped_overlay(const Image& photo) {
  Image overlay(photo.width, photo.height, 4);
  for (int row = 0; row < photo.height; ++row)
    for (int column = 0; column < photo.width; ++column) {
      if (!is_clipped(photo, row, column)) continue;
      const bool dark = (row + column) / kStripe % 2 != 0;
      overlay.at(row, column, 0) = dark ? 0.5f : 0.9f;
      overlay.at(row, column, 2) = dark ? 0.4f : 0.75f;
      overlay.at(row, column, 3) = 1;
    }
  return overlay;
}

double covered_share(const Image& overlay) {
  std::size_t covered = 0;
  for (std::size_t i = 3; i < overlay.pixels.size(); i += 4) covered += overlay.pixels[i] > 0;
  return overlay.empty() ? 0
                         : 4.0 * static_cast<double>(covered) / static_cast<double>(overlay.pixels.size());
}

}  // namespace patina
