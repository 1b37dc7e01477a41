#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/material/wood_maps.h"

/// The few numbers that loops over the pixels of wood read, made of its parameters once an image.
namespace patina::wood {

/// Where they stand: as many as the next begins after.
enum Place : std::size_t {
  kCut = 0,         ///< centre_x, centre_y, centre_z, sine and cosine of the angle
  kGnarl = 5,       ///< scale, amplitude
  kGrowth = 7,      ///< scale, amplitude, size
  kRing = 10,       ///< as wood::Ring
  kStreaks = 15,    ///< centre_x, centre_y, scale, power
  kContrast = 19,   ///< as wood::Contrast
  kRingPlanes = 28  ///< weights, and then those of the streaks' planes
};

/// A level of ValueNoise that is mixed in, along x and along y.
struct Level {
  std::size_t x, y;
};

struct Numbers {
  using Slopes = std::array<double, kParameters>;
  std::vector<double> values;
  std::vector<Slopes> by_parameters;
  std::vector<Level> ring_planes, streak_planes;

  std::size_t streak_weights() const { return kRingPlanes + ring_planes.size(); }
};

/// @param parameters  of Wood
Numbers numbers_of(const std::array<double, kParameters>& parameters, const WoodNoise& noise,
                   double pixel_cm);

/// The gradient of a scalar by the parameters, given that by the numbers.
std::array<double, kParameters> by_parameters(const Numbers& numbers, const std::vector<double>& by_numbers);

}  // namespace patina::wood
