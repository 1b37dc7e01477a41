#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/material/planes.h"

/// A glow around the middle of an image (glow.h) in one pass over the pixels of its upper left quarter.
namespace patina::glow {

constexpr int kRings = 256;          // where a glow is known, denser towards the beam
constexpr double kBeamRadius = 0.1;  // cm: spreads the peak that a beam without width would have

/// Where the pixels lie.
struct Quarter {
  const float* offset;      ///< cm from the middle, of columns and, negated, rows: as many as there are
  std::ptrdiff_t side;      ///< columns, and rows
  float nearest, farthest;  ///< of the rings, cm from the beam
  float camera_cm;
};

/// Which two rings the pixels of a row lie between: the inner one, and the outer one's share.
void places(const Quarter& quarter, std::ptrdiff_t row, std::int32_t* ring, float* share);

/// The pixels of a row: light that leaves the surface over what the flash would send to it.
/// @param log2_exitance  [kRings]
void colors(const Quarter& quarter, std::ptrdiff_t row, const float* log2_exitance, float* to);

/// The sums, column by column, of two rows of an image's planes; of a row that is its own opposite, once.
/// @param width  pixels of a row   @param to  [width]
void add_rows(const ConstPlanes& planes, std::ptrdiff_t row, std::ptrdiff_t opposite, std::ptrdiff_t width,
              float* to);

}  // namespace patina::glow
