#include "engine/material/flake.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/tensor.h>
#include <ATen/ops/zeros.h>

#include "engine/material/look_up.h"

namespace patina {
namespace {

// Of the slopes' variance, what GGX takes for a rougher surface. With all of it, as a Beckmann lobe would,
// its long tails wash a coarse image out; a quarter keeps the rings of 64 pixels nearest to those of 512.
constexpr double kSpread = 0.25;

/// The flakes' lobe. A pixel that sees several flakes has their mean slope, and is rougher by their variance:
/// alpha^2 and the slopes' second moments add (Olano, Baker 2010, "LEAN mapping").
/// @param flakes  [3, n, n], slopes along x and y and their variance (flake_map.h)   @param f0  [3]
Lobe flake_lobe(const at::Tensor& flakes, const at::Tensor& ndf, const at::Tensor& rough,
                const at::Tensor& f0) {
  const at::Tensor steepness = ndf.square();
  const at::Tensor slopes = flakes.narrow(0, 0, 2) * steepness;
  const at::Tensor up = (slopes.square().sum(0) + 1).rsqrt();
  const at::Tensor square_alpha = rough.square().square() + flakes[2] * (kSpread * steepness.square());
  const at::Tensor roughness = square_alpha.sqrt().sqrt();
  return {at::stack({slopes[0] * up, slopes[1] * up, up}), f0, roughness, roughness};
}

}  // namespace

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
  const at::Tensor flakes = without_neighbours(look_up(z.flakes(), scale, shift_x, shift_y, resolution));
  surface.lobes = {{surface.normal, top_f0, top_rough, top_rough},
                   flake_lobe(flakes, flake_ndf, flake_rough, weight * flake_f0),
                   {surface.normal, at::rsub(weight, 1) * glow_f0, glow_rough, glow_rough}};
  surface.light = p[0];
  surface.vignette_sigma = p[19];
  return surface;
}

}  // namespace patina
