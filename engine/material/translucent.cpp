#include "engine/material/translucent.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/tensor.h>
#include <ATen/ops/zeros.h>
#include <ATen/ops/zeros_like.h>

#include "engine/material/capture_view.h"
#include "engine/material/subsurface.h"

namespace patina {
namespace {

constexpr double kBeamRadius = 0.1;  // cm: spreads the peak that a beam without width would have
constexpr int kRadii = 256;          // where the glow is evaluated, denser towards the beam

/// Light that leaves the medium per area, 1/cm^2, at each pixel of those given, by interpolation of its
/// logarithm between radii.
at::Tensor glow(const Medium& medium, const at::Tensor& square_radius) {
  constexpr int kLinear = 0, kBorder = 1;
  constexpr double kDark = 1e-30;  // the logarithm of what float32 cannot hold
  const at::Tensor pixel = (square_radius + kBeamRadius * kBeamRadius).sqrt();
  const at::Tensor least = pixel.min(), range = pixel.max() - least;
  const at::Tensor share = at::arange(kRadii, pixel.options()) / (kRadii - 1);
  const at::Tensor radius = least + range * share.square();
  const at::Tensor profile =
      (multiple_scattering(medium, radius) + single_scattering(medium, radius) + kDark).log();
  const at::Tensor place = ((pixel - least) / range).sqrt() * 2 - 1;
  const at::Tensor grid = at::stack({place, at::zeros_like(place)}, -1).unsqueeze(0);
  return at::grid_sampler_2d(profile.view({1, 1, 1, kRadii}), grid, kLinear, kBorder,
                             /*align_corners=*/true)[0][0]
      .exp();
}

/// A quarter of n x n pixels, the middle row and column included where there are such.
at::Tensor quarter(const at::Tensor& image, int n) {
  const std::int64_t half = (n + 1) / 2;
  return image.narrow(0, 0, half).narrow(1, 0, half);
}

/// n x n pixels that are alike to the left and right and above and below the middle, of a quarter of them.
at::Tensor mirrored(const at::Tensor& part, int n) {
  const auto twice = [n](const at::Tensor& half, std::int64_t dimension) {
    const at::Tensor others = half.narrow(dimension, 0, n - half.size(dimension));
    return at::cat({half, others.flip(dimension)}, dimension);
  };
  return twice(twice(part, 1), 0);
}

}  // namespace

Signature Translucent::signature() { return {{"light", "sigma_s", "sigma_a", "g", "iSigma"}, {}}; }

Surface Translucent::surface(const ParameterTensors& p, std::span<const int>, const Irregularities&,
                             const Capture& capture, int resolution) const {
  const CaptureView view = capture_view(capture, resolution, p.scalar_type());
  const at::Tensor exitance = glow({.scattering = p[1], .absorption = p[2], .anisotropy = p[3]},
                                   quarter(view.square_radius, resolution));

  Surface surface;
  const at::TensorOptions constant = p.options();
  // What shading will multiply by for the flash, which is not there.
  const at::Tensor flash =
      quarter(view.direction[2], resolution) * quarter(view.inverse_square_distance, resolution);
  surface.base_color = mirrored(exitance / flash, resolution).expand({3, resolution, resolution});
  surface.height = at::zeros({1, 1}, constant).expand({resolution, resolution});
  surface.normal = at::tensor({0.0, 0.0, 1.0}, constant).view({3, 1, 1}).expand({3, resolution, resolution});
  surface.light = p[0];
  surface.vignette_sigma = p[4];
  return surface;
}

}  // namespace patina
