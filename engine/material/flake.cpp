#include "engine/material/flake.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/tensor.h>
#include <ATen/ops/zeros.h>

#include "engine/material/flake_lobe.h"

namespace patina {

Signature Flake::signature() {
  return {{"light",    "topF0",    "topRough", "flakeF0_r", "flakeF0_g", "flakeF0_b", "flakeRough",
           "flakeNDF", "scale",    "shift_x",  "shift_y",   "weight",    "glowRough", "glowF0_r",
           "glowF0_g", "glowF0_b", "albedo_r", "albedo_g",  "albedo_b",  "iSigma"},
          {},
          {"scale", "shift_x", "shift_y"},
          {"shift_x", "shift_y"}};
}

Surface Flake::surface(const ParameterTensors& p, std::span<const int>, const Irregularities& z,
                       const Capture&, int resolution) const {
  const at::Tensor top_f0 = p.run(1, 1), top_rough = p[2], flake_f0 = p.run(3, 3);
  const at::Tensor flake_rough = p[6], flake_ndf = p[7], scale = p[8], shift_x = p[9], shift_y = p[10];
  const at::Tensor weight = p[11], glow_rough = p[12], glow_f0 = p.run(13, 3);

  Surface surface;
  const at::TensorOptions constant = p.options();
  surface.base_color = p.run(16, 3).view({3, 1, 1});
  surface.height = at::zeros({1, 1}, constant).expand({resolution, resolution});
  surface.normal = at::tensor({0.0, 0.0, 1.0}, constant).view({3, 1, 1}).expand({3, resolution, resolution});
  surface.lobes = {{surface.normal, top_f0, top_rough, top_rough},
                   flake_lobe(z.flakes(), {scale, shift_x, shift_y},
                              {flake_ndf, flake_rough, weight * flake_f0}, resolution),
                   {surface.normal, at::rsub(weight, 1) * glow_f0, glow_rough, glow_rough}};
  surface.light = p[0];
  surface.vignette_sigma = p[19];
  return surface;
}

}  // namespace patina
