#include "engine/material/bump.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/fft_ifft2.h>
#include <ATen/ops/full.h>
#include <ATen/ops/polar.h>
#include <ATen/ops/real.h>
#include <ATen/ops/where.h>

#include "engine/material/heightfield.h"

namespace patina {
namespace {

/// Square of the frequency (cycles/cm) at each entry of fft2's layout, off-centre by half a bin as in
/// models.md.
at::Tensor square_frequency(int n, double size_cm, const at::TensorOptions& options) {
  const at::Tensor k = at::arange(n, options);
  const at::Tensor f = (at::where(k < n / 2, k, k - n) + 0.5) / size_cm;
  return f.square().view({n, 1}) + f.square().view({1, n});
}

}  // namespace

Surface Bump::surface(const at::Tensor& p, std::span<const int>, const Irregularities& z,
                      const Capture& capture, int resolution) const {
  const at::Tensor light = p[0], albedo = p.narrow(0, 1, 3), rough = p[4], fsigma = p[5], fscale = p[6];
  const double pixel_cm = capture.size_cm / resolution;

  const at::Tensor f2 = square_frequency(resolution, capture.size_cm, p.options().requires_grad(false));
  const at::Tensor amplitude = fscale * (f2 / (-2 * fsigma.clamp_min(1e-3).square())).exp();
  const at::Tensor spectrum = at::polar(amplitude, z.phases(resolution).to(p.scalar_type()));
  const at::Tensor height = at::real(at::fft_ifft2(spectrum)) / (pixel_cm * pixel_cm);

  Surface surface;
  surface.base_color = albedo.view({3, 1, 1});
  surface.height = height;
  surface.normal = heightfield_normals(height, pixel_cm);
  surface.lobes = {{surface.normal, at::full({3}, 0.04, p.options().requires_grad(false)), rough, rough}};
  surface.light = light;
  surface.vignette_sigma = p[7];
  return surface;
}

}  // namespace patina
