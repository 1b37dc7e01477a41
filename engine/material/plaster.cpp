#include "engine/material/plaster.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/hardtanh.h>
#include <ATen/ops/rsub.h>

#include "engine/material/heightfield.h"
#include "engine/material/look_up.h"

namespace patina {

Signature Plaster::signature() {
  return {{"light", "albedo_r", "albedo_g", "albedo_b", "rough", "rough_var", "height", "slope", "scale",
           "shift_x", "shift_y", "iSigma"},
          {{"noise", Irregularities::kMapChoices}},
          {"scale", "shift_x", "shift_y"},
          {"shift_x", "shift_y"}};
}

Surface Plaster::surface(const ParameterTensors& p, std::span<const int> discrete, const Irregularities& z,
                         const Capture& capture, int resolution) const {
  const at::Tensor rough = p[4], rough_var = p[5], height = p[6], slope = p[7];
  const at::Tensor scale = p[8], shift_x = p[9], shift_y = p[10];

  const at::Tensor noise = look_up(z.noise(discrete[0]), scale, shift_x, shift_y, resolution)[0];
  const at::Tensor heights = height * at::hardtanh(slope * noise, 0, 1);
  const at::Tensor roughness =
      at::hardtanh(rough + at::rsub(2 * without_neighbours(noise), 1) * rough_var, 0.1, 0.8);

  Surface surface;
  surface.base_color = p.run(1, 3).view({3, 1, 1});
  surface.height = without_neighbours(heights);
  surface.normal = open_normals(heights, capture.size_cm / resolution);
  surface.lobes = {dielectric_lobe(surface.normal, roughness)};
  surface.light = p[0];
  surface.vignette_sigma = p[11];
  return surface;
}

}  // namespace patina
