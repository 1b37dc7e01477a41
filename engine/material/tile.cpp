#include "engine/material/tile.h"

#include <cassert>
#include <utility>

namespace patina {
namespace {

Image mirrored(const Image& quarter) {
  const int n = quarter.width, last = 2 * n - 1;
  Image whole(2 * n, 2 * n, quarter.channels);
  for (int row = 0; row <= last; ++row)
    for (int column = 0; column <= last; ++column)
      for (int c = 0; c < quarter.channels; ++c)
        whole.at(row, column, c) =
            quarter.at(row < n ? row : last - row, column < n ? column : last - column, c);
  return whole;
}

Image mirrored_normals(const Image& quarter) {
  Image whole = mirrored(quarter);
  const int n = quarter.width;
  for (int row = 0; row < 2 * n; ++row)
    for (int column = 0; column < 2 * n; ++column) {
      if (column >= n) whole.at(row, column, 0) *= -1;
      if (row >= n) whole.at(row, column, 1) *= -1;
    }
  return whole;
}

}  // namespace

WholePeriod whole_period(const ParameterTable& table, ParameterValues values, Capture capture) {
  const auto value = [&](const char* name) -> double& {
    return values.continuous[table.find_continuous(name).value()];
  };
  const double scale = std::exchange(value("scale"), 1);
  assert(scale > 0);
  // Shifts are counted in half sides of the sample.
  value("shift_x") *= scale;
  value("shift_y") *= scale;
  capture.size_cm /= scale;
  return {std::move(values), capture};
}

MaterialMaps book_matched(const MaterialMaps& quarter) {
  MaterialMaps whole = quarter;
  whole.capture.size_cm *= 2;
  whole.base_color = mirrored(quarter.base_color);
  whole.height = mirrored(quarter.height);
  whole.normal = mirrored_normals(quarter.normal);
  for (LobeMaps& lobe : whole.lobes) {
    lobe.normal = mirrored_normals(lobe.normal);
    lobe.roughness = mirrored(lobe.roughness);
  }
  return whole;
}

}  // namespace patina
