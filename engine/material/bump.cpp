#include "engine/material/bump.h"

#include "engine/material/gaussian_heightfield.h"
#include "engine/material/heightfield.h"

namespace patina {

Signature Bump::signature() {
  return {{"light", "albedo_r", "albedo_g", "albedo_b", "rough", "fsigma", "fscale", "iSigma"}, {}};
}

Surface Bump::surface(const ParameterTensors& p, std::span<const int>, const Irregularities& z,
                      const Capture& capture, int resolution) const {
  const at::Tensor light = p[0], albedo = p.run(1, 3), rough = p[4], fsigma = p[5], fscale = p[6];

  Surface surface;
  surface.base_color = albedo.view({3, 1, 1});
  surface.height = gaussian_heightfield(z, fscale, fsigma, fsigma, capture.size_cm, resolution);
  surface.normal = heightfield_normals(surface.height, capture.size_cm / resolution);
  surface.lobes = {dielectric_lobe(surface.normal, rough)};
  surface.light = light;
  surface.vignette_sigma = p[7];
  return surface;
}

}  // namespace patina
