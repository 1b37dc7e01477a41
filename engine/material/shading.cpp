#include "engine/material/shading.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/addcmul.h>
#include <ATen/ops/hardtanh.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/where.h>

#include <cmath>
#include <numbers>

#include "engine/material/capture_view.h"

namespace patina {
namespace {

constexpr double kSmallestCosine = 1e-3;

at::Tensor cosine_to(const at::Tensor& normal, const CaptureView& view) {
  return at::hardtanh((normal * view.direction).sum(0), kSmallestCosine, 1);
}

/// D(c) / (4 c) with D of GGX: the lobe over its F0, times the cosine.
at::Tensor isotropic_lobe(const Lobe& lobe, const at::Tensor& cosine) {
  const at::Tensor square_alpha = lobe.roughness_x.square().square();
  const at::Tensor inverse = square_alpha.reciprocal();
  const at::Tensor tail = cosine.square() * (1 - inverse) + inverse;
  return (tail.square() * cosine * (square_alpha * (4 * std::numbers::pi))).reciprocal();
}

/// The same with two roughnesses: D = 1 / (pi ax ay (hx^2/ax^2 + hy^2/ay^2 + hz^2)^2), the half vector in the
/// frame of the normal whose tangent lies in the xz plane (models.md, "metal").
at::Tensor anisotropic_lobe(const Lobe& lobe, const at::Tensor& cosine, const CaptureView& view) {
  const at::Tensor nx = lobe.normal[0], nz = lobe.normal[2];
  const at::Tensor tangent_norm = (nx.square() + nz.square()).clamp_min(1e-8).sqrt();
  const at::Tensor hx = (nz * view.direction[0] - nx * view.direction[2]) / tangent_norm;
  const at::Tensor square_hy = (1 - hx.square() - cosine.square()).clamp_min(0);
  const at::Tensor ax = lobe.roughness_x.square(), ay = lobe.roughness_y.square();
  const at::Tensor tail = (hx / ax).square() + square_hy / ay.square() + cosine.square();
  return (tail.square() * cosine * (ax * ay * (4 * std::numbers::pi))).reciprocal();
}

at::Tensor over_pixels(const at::Tensor& f0) { return f0.dim() == 1 ? f0.view({-1, 1, 1}) : f0; }

}  // namespace

at::Tensor shade(const Surface& surface, const Capture& capture, int resolution) {
  const CaptureView view = capture_view(capture, resolution, surface.light.scalar_type());
  const at::Tensor vignette = (view.square_radius * (-0.5 / surface.vignette_sigma.square())).exp();
  const at::Tensor irradiance = vignette * view.inverse_square_distance * surface.light;
  const at::Tensor diffuse_cosine = cosine_to(surface.normal, view);

  at::Tensor radiance;
  for (const Lobe& lobe : surface.lobes) {
    const at::Tensor cosine =
        lobe.normal.is_same(surface.normal) ? diffuse_cosine : cosine_to(lobe.normal, view);
    const bool isotropic = lobe.roughness_x.is_same(lobe.roughness_y);
    const at::Tensor shape = isotropic ? isotropic_lobe(lobe, cosine) : anisotropic_lobe(lobe, cosine, view);
    const at::Tensor highlight = over_pixels(lobe.f0) * (shape * irradiance);
    radiance = radiance.defined() ? radiance + highlight : highlight;
  }
  const at::Tensor diffuse = diffuse_cosine * irradiance;
  const at::Tensor diffuse_albedo = surface.base_color * std::numbers::inv_pi;
  return radiance.defined() ? at::addcmul(radiance, diffuse_albedo, diffuse) : diffuse_albedo * diffuse;
}

at::Tensor display(const at::Tensor& radiance, DisplayCurve curve) {
  // The power's slope is infinite at 0, so it never sees less than a value far below one 16-bit level. Powers
  // are written exp(k log x), whose gradient costs no second power; hardtanh is a clamp with a one-pass
  // gradient.
  constexpr double kSmallest = 1e-6;
  const at::Tensor clamped = at::hardtanh(radiance, kSmallest, 1);
  if (curve == DisplayCurve::gamma22) return (clamped.log() / 2.2).exp();
  const at::Tensor power = at::rsub(clamped.log(), std::log(1.055), -1 / 2.4).exp() - 0.055;
  return at::where(clamped <= 0.0031308, clamped * 12.92, power);
}

}  // namespace patina
