#include "engine/material/leather.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/hardtanh.h>

#include "engine/material/heightfield.h"
#include "engine/material/look_up.h"

namespace patina {

Signature Leather::signature() {
  return {{"light", "albedo_r", "albedo_g", "albedo_b", "rough", "rough_var", "height", "power", "scale",
           "noise_scale", "shift_x", "shift_y", "iSigma"},
          {{"cells", Irregularities::kMapChoices}, {"noise", Irregularities::kMapChoices}},
          {"scale", "shift_x", "shift_y"},
          {"shift_x", "shift_y"}};
}

Surface Leather::surface(const ParameterTensors& p, std::span<const int> discrete, const Irregularities& z,
                         const Capture& capture, int resolution) const {
  const at::Tensor rough = p[4], rough_var = p[5], height = p[6], power = p[7], scale = p[8],
                   noise_scale = p[9];
  const at::Tensor shift_x = p[10], shift_y = p[11];

  // Cells and noise share the texture coordinate, so one look-up of a two-channel map serves both.
  const at::Tensor maps =
      look_up(z.cells_and_noise(discrete[0], discrete[1]), scale, shift_x, shift_y, resolution);
  const at::Tensor cells = without_neighbours(maps[0]);

  const at::Tensor raised = (maps[0].log() * power).exp();  // C^power; C is nowhere near 0 (cell_map.h)

  Surface surface;
  const at::Tensor heights = at::hardtanh(height * raised, 0, 1) + noise_scale * (2 * maps[1] - 1);
  surface.height = without_neighbours(heights);
  surface.normal = open_normals(heights, capture.size_cm / resolution);
  const at::Tensor roughness = at::hardtanh(rough + (1 - cells) * rough_var, 0.1, 0.8);
  surface.base_color = p.run(1, 3).view({3, 1, 1});
  surface.lobes = {dielectric_lobe(surface.normal, roughness)};
  surface.light = p[0];
  surface.vignette_sigma = p[12];
  return surface;
}

}  // namespace patina
