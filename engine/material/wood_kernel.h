#pragma once

#include <array>
#include <cstddef>

#include "engine/material/planes.h"

/// Growth rings (growth_rings.h) and what goes with them (wood_maps.h) in one pass over pixels, and their
/// gradients.
namespace patina::wood {

/// A ring's latewood ratio as numbers: a trapezoid that rises to `top` over `rise`, falls over `fall` until
/// `end`, all in rings from where the ring begins; and its mean over the whole ring.
struct Ring {
  float end, top, rise, fall, mean;
};
constexpr std::size_t kRingNumbers = 5;

using Colour = std::array<float, 3>;

/// What latewood differs in from earlywood: colour, height in cm, roughness, and what earlywood's is more.
struct Contrast {
  Colour earlywood, latewood;
  float latewood_height, latewood_roughness, earlywood_roughness_more;
};
constexpr std::size_t kContrastNumbers = 9;

/// A field of rings, [rows, columns], both at least 2.
struct RingField {
  const float* rings;
  std::ptrdiff_t rows, columns;
};

/// The first `rows` of ring_widths().
void ring_widths(const RingField& field, std::ptrdiff_t rows, float* width);

/// Adds the gradient of a scalar by the rings, given that by the first `rows` of widths.
void ring_widths_backward(const RingField& field, std::ptrdiff_t rows, const float* width,
                          const float* gradient, float* by_rings);

/// Rows of a grid, [rows, side + 1]. Those from `first` on, without the last column, are of pixels.
struct Rows {
  const float *rings, *width;
  const float* exponent;  ///< of the pixels' colour, [rows - first, side]
  std::ptrdiff_t rows, first, side;
};

/// A height that all wood has.
struct Grain {
  const float* height;  ///< of the grid
  float cm;
};

/// Of the first pixel, or of the first of the grid.
struct MapsTo {
  Planes color;
  float* height;  ///< of the grid
  float* roughness;
};

/// How much latewood a pixel shows (latewood_ratio()), and what that makes of it.
void finish(const Ring& ring, const Contrast& contrast, const Rows& rows, const Grain& grain,
            const MapsTo& to);

/// That of a scalar by what finish() writes.
struct MapsGradient {
  ConstPlanes color;
  const float *height, *roughness;
};

struct RowsGradient {
  float *rings, *width, *exponent;  ///< written
  double *ring, *contrast;          ///< by their numbers, in their order; added to
};

/// The gradient of a scalar that rows make, few enough to add up in float32. @param color  what finish() made
void finish_backward(const Ring& ring, const Contrast& contrast, const Rows& rows, const ConstPlanes& color,
                     const MapsGradient& given, const RowsGradient& by);

}  // namespace patina::wood
