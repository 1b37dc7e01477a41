#pragma once

#include <span>
#include <vector>

#include "engine/image.h"

namespace patina {

/// A grid of counts as a density: smoothed by a Gaussian of so many cells' standard deviation either way.
/// What it carries beyond the border is lost, so that the border should lie two standard deviations off the
/// data.
Image smoothed_counts(const Image& counts, double sd_across, double sd_down);

/// For each share, the level above which the grid holds that share of its sum: the edge of the smallest
/// region of that probability (highest density region; Hyndman 1996).
/// @param shares  between 0 and 1
std::vector<double> highest_density_levels(const Image& density, std::span<const double> shares);

}  // namespace patina
