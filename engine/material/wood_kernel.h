#pragma once

#include <array>
#include <cstddef>

#include "engine/material/planes.h"

/// Growth rings (growth_rings.h) and the colour of wood (wood_color.h) in one pass over pixels, and their
/// gradients.
namespace patina::wood {

/// A ring's latewood ratio as numbers: a trapezoid that rises to `top` over `rise`, falls over `fall` until
/// `end`, all in rings from where the ring begins; and its mean over the whole ring.
struct Ring {
  float end, top, rise, fall, mean;
};
constexpr std::size_t kRingNumbers = 5;

/// Pixels begin ... end - 1 of latewood_ratio().
void latewood_ratio(const Ring& ring, const float* rings, const float* width, std::ptrdiff_t begin,
                    std::ptrdiff_t end, float* ratio);

/// Writes the gradient of a scalar by rings and width, given that by the ratio, and adds that by the ring's
/// numbers, in their order. Few enough pixels to add up in float32.
void latewood_ratio_backward(const Ring& ring, const float* rings, const float* width, std::ptrdiff_t begin,
                             std::ptrdiff_t end, const float* gradient, float* by_rings, float* by_width,
                             double* by_ring);

/// A field of rings, [rows, columns], both at least 2.
struct RingField {
  const float* rings;
  std::ptrdiff_t rows, columns;
};

/// Rows begin ... end - 1 of ring_widths().
void ring_widths(const RingField& field, std::ptrdiff_t begin, std::ptrdiff_t end, float* width);

/// Adds the gradient of a scalar by the rings, given that by the widths. All rows, which share rings.
void ring_widths_backward(const RingField& field, const float* width, const float* gradient, float* by_rings);

using Colour = std::array<float, 3>;

/// Pixels begin ... end - 1 of wood_color().
void wood_color(const Colour& earlywood, const Colour& latewood, const float* ratio, const float* exponent,
                std::ptrdiff_t begin, std::ptrdiff_t end, const Planes& color);

/// Writes the gradient of a scalar by ratio and exponent, given that by the colour, and adds those by
/// earlywood and by latewood, [3] each. Few enough pixels to add up in float32.
/// @param color  what wood_color() made
void wood_color_backward(const Colour& earlywood, const Colour& latewood, const float* ratio,
                         const float* exponent, std::ptrdiff_t begin, std::ptrdiff_t end,
                         const ConstPlanes& color, const ConstPlanes& gradient, float* by_ratio,
                         float* by_exponent, double* by_earlywood, double* by_latewood);

}  // namespace patina::wood
