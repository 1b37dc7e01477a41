#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/hardtanh.h>
#include <ATen/ops/lerp.h>
#include <ATen/ops/pow.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/zeros_like.h>

#include <numbers>

#include "engine/material/growth_rings.h"
#include "engine/material/look_up.h"
#include "engine/material/value_noise.h"
#include "engine/material/wood_maps.h"

namespace patina {
namespace {

using namespace wood;

/// Where the cut meets the trunk, whose axis is z: cm, [n + 1] with neighbours (open_normals).
struct CutPlaces {
  at::Tensor x, y, z;    ///< of columns, of rows, and of rows
  at::Tensor stretch_y;  ///< scalar: how far y goes per cm of the image's
};

/// The image's y points down here, as in the paper's code.
/// @param centre  [3], cm   @param angle  degrees
CutPlaces cut_through(const at::Tensor& centre, const at::Tensor& angle, double size_cm, std::int64_t n) {
  const at::Tensor pixel = at::arange(-1, n + 1, centre.options().requires_grad(false));
  const at::Tensor place = ((pixel + 0.5) / static_cast<double>(n) - 0.5) * size_cm;
  const at::Tensor columns = place.narrow(0, 1, n + 1), rows = place.narrow(0, 0, n + 1);
  const at::Tensor radians = angle * (std::numbers::pi / 180);
  const at::Tensor sine = radians.sin(), cosine = radians.cos();
  return {columns + centre[0], rows * sine + centre[1], rows * cosine + centre[2], sine.abs()};
}

/// Distance from the pith in rings: (r + amplitude N(scale r)) / size, r = sqrt(x^2 + y^2 + 1e-6 cm^2).
at::Tensor rings_from_pith(const WarpedGrid& place, const ParameterTensors& p, const ValueNoise& noise,
                           double pixel_cm) {
  const at::Tensor radius = (place.x.square() + place.y.square() + 1e-6).sqrt();
  const at::Tensor width = (p[kGrowthScale] * pixel_cm).clamp_min(kThinnestPixel);
  const at::Tensor lengthening =
      value_noise(noise, p[kGrowthScale] * radius, at::zeros_like(radius), width, width);
  return (radius + p[kGrowthAmplitude] * lengthening) / p[kRingSize].clamp_min(kThinnestRing);
}

/// What the colour is raised to: 1 + power N(scale (place - centre)).
at::Tensor streak_exponent(const WarpedGrid& place, const CutPlaces& cut, const at::Tensor& centre,
                           const ParameterTensors& p, const ValueNoise& noise, double pixel_cm) {
  const at::Tensor width = p[kStreakScale] * pixel_cm;
  const auto across = [&](const at::Tensor& at, const at::Tensor& middle) {
    return (without_neighbours(at) - middle) * p[kStreakScale];
  };
  const at::Tensor seen = value_noise(noise, across(place.x, centre[0]), across(place.y, centre[1]), width,
                                      (width * cut.stretch_y).clamp_min(kThinnestPixel));
  return p[kStreakPower] * seen + 1;
}

}  // namespace

WoodMaps wood_maps_by_tensors(const ParameterTensors& p, const WoodNoise& noise, const at::Tensor& grain,
                              double size_cm) {
  const std::int64_t n = grain.size(0) - 1;
  const double pixel_cm = size_cm / static_cast<double>(n);
  const at::Tensor albedo = p.run(kAlbedo, 3), centre = p.run(kCentre, 3);
  const CutPlaces cut = cut_through(centre, p[kCutAngle], size_cm, n);
  const WarpedGrid place =
      warp_grid(noise.distortion, cut.x, cut.y, cut.z * kAlongGrain, p[kGnarlScale], p[kGnarlAmplitude]);
  const at::Tensor rings = rings_from_pith(place, p, noise.ring_widths, pixel_cm);
  const RingProfile profile{.earlywood_ramp = p[kEarlywoodRamp],
                            .latewood_ramp = p[kLatewoodRamp],
                            .latewood_fraction = p[kLatewoodFraction]};
  const at::Tensor ratio = latewood_ratio(profile, rings, ring_widths(rings)),
                   here = without_neighbours(ratio);

  const at::Tensor mixed =
      at::lerp(albedo.view({3, 1, 1}), albedo.pow(p[kLatewoodPower]).view({3, 1, 1}), here);
  // A power is written exp(k log x), whose gradient costs no second power.
  const at::Tensor exponent = streak_exponent(place, cut, centre, p, noise.streaks, pixel_cm);
  return {.color = (mixed.log() * exponent).exp(),
          .height = ratio * p[kLatewoodHeight] + kGrainHeight * grain,
          .roughness = at::hardtanh(p[kRough] + at::rsub(here, 1) * p[kEarlywoodRough], 0, 1)};
}

}  // namespace patina
