#pragma once

#include <cstddef>

#include "engine/material/planes.h"

/// The flakes' lobe (flake_lobe.h) in one pass over pixels, and its gradient in another.
namespace patina::flake {

/// Of the slopes' variance, what GGX takes for a rougher surface. With all of it, as a Beckmann lobe would,
/// its long tails wash a coarse image out; a quarter keeps the rings of 64 pixels nearest to those of 512.
constexpr float kSpread = 0.25F;

/// What the pixels share: how much steeper than the map flakes lie, and alpha^2 of one flake alone.
struct Gloss {
  float steepness, square_alpha;
};

/// Pixels begin ... end - 1 of flake_lobe(): normals and roughness.
void lobe(const Gloss& gloss, const ConstPlanes& flakes, std::ptrdiff_t begin, std::ptrdiff_t end,
          const Planes& normal, float* roughness);

/// What lobe() made, or the gradient of a scalar by it.
struct Lobe {
  ConstPlanes normal;
  const float* roughness;
};

/// Writes the gradient of a scalar by the flakes, and adds those by the gloss, in its order. Few enough
/// pixels to add up in float32.
void lobe_backward(const Gloss& gloss, const ConstPlanes& flakes, const Lobe& lobe, const Lobe& gradient,
                   std::ptrdiff_t begin, std::ptrdiff_t end, const Planes& by_flakes, double* by_gloss);

}  // namespace patina::flake
