#include "engine/material/wood.h"

#include <ATen/TensorOperators.h>

#include "engine/material/heightfield.h"
#include "engine/material/look_up.h"
#include "engine/material/wood_maps.h"

namespace patina {
namespace {

constexpr double kNarrowestVignette = 0.1;  // cm

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
  const WoodMaps maps = wood_maps(p, z.wood(), z.grain(resolution), capture.size_cm);
  Surface surface;
  surface.base_color = maps.color;
  surface.height = without_neighbours(maps.height);
  surface.normal = open_normals(maps.height, capture.size_cm / resolution);
  surface.lobes = {dielectric_lobe(surface.normal, maps.roughness)};
  surface.light = p[0];
  surface.vignette_sigma = p[wood::kVignette].clamp_min(kNarrowestVignette);
  return surface;
}

}  // namespace patina
