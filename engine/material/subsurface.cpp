#include "engine/material/subsurface.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/rsub.h>

#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kIndex = 1.5;
constexpr double kEntering = 1 - (kIndex - 1) * (kIndex - 1) / ((kIndex + 1) * (kIndex + 1));
constexpr int kNodes = 64;  // of each quadrature

/// Fresnel reflectance of unpolarised light from within, at the cosine of its angle to the normal.
double reflectance_within(double cosine) {
  const double square_sine = kIndex * kIndex * (1 - cosine * cosine);
  if (square_sine >= 1) return 1;
  const double outside = std::sqrt(1 - square_sine);
  const double parallel = (cosine - kIndex * outside) / (cosine + kIndex * outside);
  const double perpendicular = (kIndex * cosine - outside) / (kIndex * cosine + outside);
  return (parallel * parallel + perpendicular * perpendicular) / 2;
}

/// The integral of F(c) c^k over c from 0 to 1.
double reflectance_moment(int k) {
  constexpr int kSteps = 4096;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    sum += reflectance_within(cosine) * std::pow(cosine, k) / kSteps;
  }
  return sum;
}

/// The middles of kNodes equal parts of [0,1].
at::Tensor nodes(const at::TensorOptions& options) {
  return (at::arange(kNodes, options.requires_grad(false)) + 0.5) / kNodes;
}

/// Fluence and flux through the surface of a point source at a distance, over 1 / (4 pi).
struct Source {
  at::Tensor fluence, flux;
  Source(const at::Tensor& depth, const at::Tensor& distance, const at::Tensor& decay)
      : fluence((-decay * distance).exp() / distance),
        flux(depth * (decay * distance + 1) * fluence / distance.square()) {}
};

}  // namespace

at::Tensor multiple_scattering(const Medium& medium, const at::Tensor& radius) {
  static const double first = reflectance_moment(1), second = reflectance_moment(2);
  const at::Tensor scattering = at::rsub(medium.anisotropy, 1) * medium.scattering;
  const at::Tensor extinction = scattering + medium.absorption, albedo = scattering / extinction;
  const at::Tensor diffusion = (2 * medium.absorption + scattering) / (3 * extinction.square());
  const at::Tensor decay = (medium.absorption / diffusion).sqrt();
  const double mismatch = (1 + 3 * second) / (1 - 2 * first);

  // Real sources where the beam first scatters, and their images above the extrapolated boundary.
  const at::Tensor depth = -at::rsub(nodes(radius.options()), 1).log() / extinction;
  const at::Tensor image_depth = depth + 4 * mismatch * diffusion;
  const at::Tensor square_radius = radius.square().unsqueeze(1);
  const at::Tensor distance = (square_radius + depth.square()).sqrt();
  const Source real(depth, distance, decay);
  const Source image(image_depth, (square_radius + image_depth.square()).sqrt(), decay);

  const at::Tensor exitance = (1 - 2 * first) / 4 / diffusion * (real.fluence - image.fluence) +
                              (1 - 3 * second) / 2 * (real.flux + image.flux);
  const at::Tensor correction = at::rsub((-2 * extinction * (distance + depth)).exp(), 1);
  return (exitance * correction).mean(1) * albedo.square() * (kEntering / (4 * kPi));
}

at::Tensor single_scattering(const Medium& medium, const at::Tensor& radius) {
  // The angle at the surface point between the surface and the beam's point of depth radius tan(angle).
  const at::Tensor angle = nodes(radius.options()) * (kPi / 2);
  const at::Tensor cosine = angle.sin();  // to the normal
  at::Tensor leaving = cosine.detach().clone();
  for (int i = 0; i < kNodes; ++i) leaving[i] = 1 - reflectance_within(cosine[i].item<double>());
  const at::Tensor path = radius.unsqueeze(1) * ((1 + cosine) / angle.cos());

  const at::Tensor g = medium.anisotropy, square_g = g.square();
  const at::Tensor base = 1 + square_g + 2 * g * cosine;
  const at::Tensor phase = at::rsub(square_g, 1) / (base * base.sqrt()) / (4 * kPi);
  const at::Tensor reached = (-(medium.scattering + medium.absorption) * path).exp();
  return (reached * (phase * cosine * leaving)).mean(1) * medium.scattering / radius * (kEntering * kPi / 2);
}

}  // namespace patina
