#pragma once

#include "engine/material/capture.h"
#include "engine/material/maps.h"
#include "engine/material/parameter.h"

namespace patina {

/// What can be laid side by side without a seam of a material's surface.
enum class Tiling {
  sample,        ///< the sample itself: its surface is periodic
  map,           ///< one period of the maps that it looks up, 1 / scale samples wide
  book_matched,  ///< it never repeats: the sample with its mirror images, as veneers are laid
  none,          ///< nothing: it belongs to one place
};

/// A sample that shows one whole period of a material's maps.
struct WholePeriod {
  ParameterValues values;
  Capture capture;
};

/// Widens a sample about its centre until it shows one whole period of the maps that the parameters scale,
/// shift_x and shift_y look up (look_up.h): all features keep their size in centimetres and their place.
/// @param table  has those parameters, scale above 0
WholePeriod whole_period(const ParameterTable& table, ParameterValues values, Capture capture);

/// Four mirror images as one picture of twice the side: itself at the top left. Base colour, height and
/// roughness continue over every border; normals lean the other way beyond it, as a mirror shows them.
MaterialMaps book_matched(const MaterialMaps& quarter);

}  // namespace patina
