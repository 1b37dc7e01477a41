#include "engine/material/translucent.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/tensor.h>
#include <ATen/ops/zeros.h>

#include "engine/material/glow.h"
#include "engine/material/subsurface.h"

namespace patina {
namespace {

constexpr double kDark = 1e-30;  // has a logarithm, where float32 cannot hold what leaves

}  // namespace

Signature Translucent::signature() { return {{"light", "sigma_s", "sigma_a", "g", "iSigma"}, {}}; }

Surface Translucent::surface(const ParameterTensors& p, std::span<const int>, const Irregularities&,
                             const Capture& capture, int resolution) const {
  const Medium medium{.scattering = p[1], .absorption = p[2], .anisotropy = p[3]};
  const at::TensorOptions constant = p.options();
  const at::Tensor rings = glow_rings(capture, resolution, constant);
  const at::Tensor exitance = multiple_scattering(medium, rings) + single_scattering(medium, rings);

  Surface surface;
  surface.base_color = glow_color((exitance + kDark).log2(), capture, resolution);
  surface.height = at::zeros({1, 1}, constant).expand({resolution, resolution});
  surface.normal = at::tensor({0.0, 0.0, 1.0}, constant).view({3, 1, 1}).expand({3, resolution, resolution});
  surface.light = p[0];
  surface.vignette_sigma = p[4];
  return surface;
}

}  // namespace patina
