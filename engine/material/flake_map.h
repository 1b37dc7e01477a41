#pragma once

#include <cstdint>

#include "engine/material/look_up.h"

namespace patina {

/// A periodic map of flakes: each Voronoi cell of a blue-noise point set, about 5 texels wide at size 1024,
/// has one slope drawn from the unit Beckmann distribution (models.md, "The maps"; Beckmann and Spizzichino
/// 1963).
/// @return three channels: at the finest level the slopes along x and y in [-1,1] and zero, at the others
/// their means and the sum of their two variances (Olano, Baker 2010, "LEAN mapping")
MipMap make_flake_map(std::uint64_t seed, std::uint64_t stream, int size);

}  // namespace patina
