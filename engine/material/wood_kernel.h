#pragma once

#include <array>
#include <cstddef>

#include "engine/material/planes.h"

/// Growth rings (growth_rings.h) and what goes with them (wood_finish.h) in one pass over pixels, and their
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

/// LatewoodContrast (wood_finish.h).
struct Contrast {
  Colour earlywood, latewood;
  float latewood_height, latewood_roughness, earlywood_roughness_more;
};
constexpr std::size_t kContrastNumbers = 9;

/// Pixels [side, side], which are those of a grid, [side + 1, side + 1], without its first row and its last
/// column.
struct LatewoodField {
  const float* ratio;     ///< of the grid
  const float* exponent;  ///< of the pixels
  std::ptrdiff_t side;
};

struct Grain {
  const float* height;  ///< of the grid
  float cm;
};

struct FinishTo {
  Planes color;
  float* height;  ///< of the grid
  float* roughness;
};

/// Rows begin ... end - 1 of the grid, of wood_finish().
void finish(const Contrast& contrast, const LatewoodField& field, const Grain& grain, std::ptrdiff_t begin,
            std::ptrdiff_t end, const FinishTo& to);

/// That of a scalar by what finish() writes.
struct FinishGradient {
  ConstPlanes color;
  const float *height, *roughness;
};

struct LatewoodGradient {
  float *ratio, *exponent;  ///< written
  double* contrast;         ///< by its numbers, in their order; added to
};

/// The gradient of a scalar that rows begin ... end - 1 make, few enough to add up in float32.
/// @param color  what finish() made
void finish_backward(const Contrast& contrast, const LatewoodField& field, const ConstPlanes& color,
                     std::ptrdiff_t begin, std::ptrdiff_t end, const FinishGradient& given,
                     const LatewoodGradient& by);

}  // namespace patina::wood
