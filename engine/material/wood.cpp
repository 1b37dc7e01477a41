#include "engine/material/wood.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/pow.h>

#include <numbers>

#include "engine/material/growth_rings.h"
#include "engine/material/heightfield.h"
#include "engine/material/look_up.h"
#include "engine/material/rings_from_pith.h"
#include "engine/material/value_noise.h"
#include "engine/material/wood_finish.h"
#include "engine/material/wood_streaks.h"

namespace patina {
namespace {

// Along the trunk the distortion changes ten times more slowly than across it: grain runs straight.
constexpr double kAlongGrain = 0.1;
constexpr double kThinnestRing = 1e-3;      // cm
constexpr double kNarrowestVignette = 0.1;  // cm
// Noise that breaks up the highlight: small, and the same for all wood.
constexpr double kGrainHeight = 0.004;  // cm

/// Where the cut meets the trunk, whose axis is z: cm, [n + 1] with neighbours (open_normals).
struct Cut {
  at::Tensor x, y, z;    ///< of columns, of rows, and of rows
  at::Tensor stretch_y;  ///< scalar: how far y goes per cm of the image's
};

/// The image's y points down here, as in the paper's code.
/// @param centre  [3], cm   @param angle  degrees
Cut cut_through(const at::Tensor& centre, const at::Tensor& angle, double size_cm, int n) {
  const at::Tensor pixel = at::arange(-1, n + 1, centre.options().requires_grad(false));
  const at::Tensor place = ((pixel + 0.5) / n - 0.5) * size_cm;
  const at::Tensor columns = place.narrow(0, 1, n + 1), rows = place.narrow(0, 0, n + 1);
  const at::Tensor radians = angle * (std::numbers::pi / 180);
  const at::Tensor sine = radians.sin(), cosine = radians.cos();
  return {columns + centre[0], rows * sine + centre[1], rows * cosine + centre[2], sine.abs()};
}

}  // namespace

Signature Wood::signature() {
  return {{"light",     "albedo_r",  "albedo_g",  "albedo_b",      "center_x",      "center_y",
           "center_z",  "ring_size", "lw_power",  "lw_fraction",   "ew_ramp_width", "lw_ramp_width",
           "ssn_scale", "ssn_power", "grn_scale", "grn_amplitude", "gdn_scale",     "gdn_amplitude",
           "cut_angle", "rough",     "ew_rough",  "lw_height",     "iSigma"},
          {},
          // Where rings and streaks, a pixel or two wide, meet the pixels.
          {"center_x", "center_y", "ring_size", "ssn_scale", "cut_angle"}};
}

Surface Wood::surface(const ParameterTensors& p, std::span<const int>, const Irregularities& z,
                      const Capture& capture, int resolution) const {
  const at::Tensor albedo = p.run(1, 3), centre = p.run(4, 3), ring_size = p[7];
  const at::Tensor lw_power = p[8], ssn_scale = p[12], ssn_power = p[13], grn_scale = p[14],
                   grn_amplitude = p[15], gdn_scale = p[16], gdn_amplitude = p[17], cut_angle = p[18];
  const at::Tensor rough = p[19], ew_rough = p[20], lw_height = p[21];
  const RingProfile profile{.earlywood_ramp = p[10], .latewood_ramp = p[11], .latewood_fraction = p[9]};
  const WoodNoise noise = z.wood();
  const double pixel_cm = capture.size_cm / resolution;

  const Cut plane = cut_through(centre, cut_angle, capture.size_cm, resolution);
  // Gnarl.
  const WarpedGrid cut =
      warp_grid(noise.distortion, plane.x, plane.y, plane.z * kAlongGrain, gdn_scale, gdn_amplitude);
  const at::Tensor rings = rings_from_pith(
      cut, {grn_scale, grn_amplitude, ring_size.clamp_min(kThinnestRing)}, noise.ring_widths, pixel_cm);
  const at::Tensor latewood = latewood_ratio(profile, rings, ring_widths(rings));
  const at::Tensor width = ssn_scale * pixel_cm;
  const at::Tensor exponent =
      streak_exponent(cut, {ssn_scale, ssn_power, centre[0], centre[1]}, noise.streaks, width,
                      (width * plane.stretch_y).clamp_min(1e-6));

  const WoodFinish finish = wood_finish({albedo, albedo.pow(lw_power), lw_height, rough, ew_rough}, latewood,
                                        exponent, z.grain(resolution), kGrainHeight);

  Surface surface;
  surface.base_color = finish.color;
  surface.height = without_neighbours(finish.height);
  surface.normal = open_normals(finish.height, pixel_cm);
  surface.lobes = {dielectric_lobe(surface.normal, finish.roughness)};
  surface.light = p[0];
  surface.vignette_sigma = p[22].clamp_min(kNarrowestVignette);
  return surface;
}

}  // namespace patina
