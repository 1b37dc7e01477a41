#pragma once

#include <vector>

#include "engine/image.h"

namespace patina {

/// A piece of a contour; in cells of the grid, the middle of the first cell at (0.5, 0.5).
struct ContourPiece {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// The lines along which a grid passes through a level, linear between the middles of its cells (marching
/// squares; at a saddle the lines go around what is above the level). Beyond the border the grid counts as 0,
/// so that every line is closed where the level is above 0.
std::vector<ContourPiece> contour_lines(const Image& grid, double level);

}  // namespace patina
