#include "engine/material/shading.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/ones_like.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/where.h>

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>

namespace patina {
namespace {

constexpr double kSmallestCosine = 1e-3;

/// What depends on the capture alone.
struct View {
  at::Tensor direction;                ///< [3, n, n], unit, from the surface point to camera and light
  at::Tensor inverse_square_distance;  ///< [n, n], 1/cm^2
  at::Tensor square_radius;            ///< [n, n], cm^2 from the sample's centre
};

View make_view(const Capture& capture, int n, at::ScalarType type) {
  const at::NoGradGuard no_grad;
  const at::Tensor step = ((at::arange(n, at::kDouble) + 0.5) / n - 0.5) * capture.size_cm;
  const at::Tensor x = step.view({1, n}).expand({n, n});
  const at::Tensor y = -step.view({n, 1}).expand({n, n});
  View view;
  const at::Tensor square_radius = x * x + y * y;
  const at::Tensor square_distance = square_radius + capture.camera_cm * capture.camera_cm;
  const at::Tensor z = at::ones_like(square_radius) * capture.camera_cm;
  view.direction = (at::stack({-x, -y, z}) / square_distance.sqrt()).to(type);
  view.inverse_square_distance = square_distance.reciprocal().to(type);
  view.square_radius = square_radius.to(type);
  return view;
}

/// Views are few and asked for at every evaluation, so they are kept.
View view_of(const Capture& capture, int n, at::ScalarType type) {
  static std::mutex mutex;
  static std::map<std::tuple<double, double, int, at::ScalarType>, View> views;
  const std::lock_guard lock(mutex);
  const auto key = std::make_tuple(capture.size_cm, capture.camera_cm, n, type);
  const auto found = views.find(key);
  if (found != views.end()) return found->second;
  return views.emplace(key, make_view(capture, n, type)).first->second;
}

/// GGX without shadowing over the half vector w: F0 D(c) / (4 c^2) times the cosine c.
at::Tensor isotropic_lobe(const Lobe& lobe, const View& view) {
  const at::Tensor cosine = (lobe.normal * view.direction).sum(0).clamp(kSmallestCosine, 1);
  const at::Tensor square_cosine = cosine.square();
  const at::Tensor square_alpha = lobe.roughness_x.square().square();
  const at::Tensor tail = (1 - square_cosine) / square_alpha + square_cosine;
  return (square_alpha * tail.square() * cosine).mul(4 * std::numbers::pi).reciprocal();
}

/// The same with two roughnesses: D = 1 / (pi ax ay (hx^2/ax^2 + hy^2/ay^2 + hz^2)^2), the half vector in the
/// frame of the normal whose tangent lies in the xz plane (models.md, "metal").
at::Tensor anisotropic_lobe(const Lobe& lobe, const View& view) {
  const at::Tensor nx = lobe.normal[0], ny = lobe.normal[1], nz = lobe.normal[2];
  const at::Tensor hz = (lobe.normal * view.direction).sum(0).clamp(kSmallestCosine, 1);
  const at::Tensor tangent_norm = (nx.square() + nz.square()).clamp_min(1e-8).sqrt();
  const at::Tensor hx = (nz * view.direction[0] - nx * view.direction[2]) / tangent_norm;
  const at::Tensor square_hy = (1 - hx.square() - hz.square()).clamp_min(0);
  const at::Tensor ax = lobe.roughness_x.square(), ay = lobe.roughness_y.square();
  const at::Tensor tail = (hx / ax).square() + square_hy / ay.square() + hz.square();
  return (ax * ay * tail.square() * hz).mul(4 * std::numbers::pi).reciprocal();
}

at::Tensor as_colour(const at::Tensor& f0) { return f0.dim() == 1 ? f0.view({3, 1, 1}) : f0; }

}  // namespace

at::Tensor shade(const Surface& surface, const Capture& capture, int resolution) {
  const View view = view_of(capture, resolution, surface.light.scalar_type());
  const at::Tensor cosine = (surface.normal * view.direction).sum(0).clamp(kSmallestCosine, 1);
  at::Tensor reflected = surface.base_color * (cosine / std::numbers::pi);
  for (const Lobe& lobe : surface.lobes) {
    const bool isotropic = lobe.roughness_x.is_same(lobe.roughness_y);
    reflected = reflected +
                as_colour(lobe.f0) * (isotropic ? isotropic_lobe(lobe, view) : anisotropic_lobe(lobe, view));
  }
  const at::Tensor vignette = (view.square_radius / (-2 * surface.vignette_sigma.square())).exp();
  return reflected * (surface.light * vignette * view.inverse_square_distance);
}

at::Tensor display(const at::Tensor& radiance, DisplayCurve curve) {
  // The power's slope is infinite at 0, so it never sees less than a value far below one 16-bit level.
  constexpr double kSmallest = 1e-6;
  const at::Tensor clamped = radiance.clamp(kSmallest, 1);
  if (curve == DisplayCurve::gamma22) return clamped.pow(1 / 2.2);
  const at::Tensor power = clamped.clamp_min(0.0031308).pow(1 / 2.4) * 1.055 - 0.055;
  return at::where(clamped <= 0.0031308, clamped * 12.92, power);
}

}  // namespace patina
