#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/irregularities.h"
#include "engine/material/parameter_tensors.h"

namespace patina {

/// What a cut through a trunk shows (models.md "wood"), of an image of n x n pixels.
struct WoodMaps {
  at::Tensor color;      ///< [3, n, n], linear
  at::Tensor height;     ///< [n + 1, n + 1], cm, with neighbours (look_up.h)
  at::Tensor roughness;  ///< [n, n], in [0,1]
};

/// The cut's points move by noise (warp_grid); how far they then are from the pith, and noise of that, say
/// how many rings lie between (RingGrowth); each ring begins with earlywood and ends with latewood
/// (RingProfile), in which colour, height and roughness differ. The colour is raised to a power that varies
/// with streaks, which go with the sample, not with the trunk: that is the same to look at, and a move of the
/// sample or a little more of their scale does not exchange all of them. Rings and noise are averaged over
/// each pixel.
/// @param parameters  of Wood
/// @param grain       a heightfield that all wood has: [n + 1, n + 1]; not differentiated
/// @param size_cm     of the image
/// In float32 one pass over the pixels, and one for the gradient, which has no further derivatives; else as
/// wood_maps_by_tensors(), the reference.
WoodMaps wood_maps(const ParameterTensors& parameters, const WoodNoise& noise, const at::Tensor& grain,
                   double size_cm);
WoodMaps wood_maps_by_tensors(const ParameterTensors& parameters, const WoodNoise& noise,
                              const at::Tensor& grain, double size_cm);

namespace wood {

/// Along the trunk the distortion changes ten times more slowly than across it: grain runs straight.
constexpr double kAlongGrain = 0.1;
constexpr double kThinnestRing = 1e-3;   // cm
constexpr double kThinnestPixel = 1e-6;  // lattice cells of noise
/// Noise that breaks up the highlight: small, and the same for all wood.
constexpr double kGrainHeight = 0.004;  // cm

/// Where the parameters stand.
enum ParameterIndex : std::size_t {
  kAlbedo = 1,
  kCentre = 4,
  kRingSize = 7,
  kLatewoodPower,
  kLatewoodFraction,
  kEarlywoodRamp,
  kLatewoodRamp,
  kStreakScale,
  kStreakPower,
  kGrowthScale,
  kGrowthAmplitude,
  kGnarlScale,
  kGnarlAmplitude,
  kCutAngle,
  kRough,
  kEarlywoodRough,
  kLatewoodHeight,
  kVignette,
  kParameters
};

}  // namespace wood
}  // namespace patina
