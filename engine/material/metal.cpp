#include "engine/material/metal.h"

#include <ATen/ops/zeros.h>

#include "engine/material/gaussian_heightfield.h"
#include "engine/material/heightfield.h"

namespace patina {

Signature Metal::signature() {
  return {{"light", "f0_r", "f0_g", "f0_b", "roughx", "roughy", "fsigmax", "fsigmay", "fscale", "iSigma"},
          {}};
}

Surface Metal::surface(const ParameterTensors& p, std::span<const int>, const Irregularities& z,
                       const Capture& capture, int resolution) const {
  const at::Tensor roughx = p[4], roughy = p[5], fsigmax = p[6], fsigmay = p[7], fscale = p[8];

  Surface surface;
  surface.base_color = at::zeros({3, 1, 1}, p.options());
  surface.height = gaussian_heightfield(z, fscale, fsigmax, fsigmay, capture.size_cm, resolution);
  surface.normal = heightfield_normals(surface.height, capture.size_cm / resolution);
  surface.lobes = {{surface.normal, p.run(1, 3), roughx, roughy}};
  surface.light = p[0];
  surface.vignette_sigma = p[9];
  return surface;
}

}  // namespace patina
