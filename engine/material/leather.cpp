#include "engine/material/leather.h"

#include "engine/material/heightfield.h"
#include "engine/material/leather_finish.h"
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
  const LeatherFinish finish = leather_finish({height, power, noise_scale, rough, rough_var}, maps);

  Surface surface;
  surface.height = without_neighbours(finish.height);
  surface.normal = open_normals(finish.height, capture.size_cm / resolution);
  surface.base_color = p.run(1, 3).view({3, 1, 1});
  surface.lobes = {dielectric_lobe(surface.normal, finish.roughness)};
  surface.light = p[0];
  surface.vignette_sigma = p[12];
  return surface;
}

}  // namespace patina
