#pragma once

#include <cstdint>
#include <vector>

#include "gui/plot/density_grid.h"

namespace patina {

/// What the colour of a density map tells: how many points there are, or the points' own colours on average.
enum class DensityColours { count, mean };

/// Cells as a picture: slightly smoothed, on a logarithmic scale up to the fullest cell, points that
/// are dimmed in grey beneath the others. Four bytes a cell, RGBA, premultiplied, rows from the top.
std::vector<std::uint8_t> density_picture(const DensityCells& cells, DensityColours colours);

}  // namespace patina
