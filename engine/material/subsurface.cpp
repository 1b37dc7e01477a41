#include "engine/material/subsurface.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/tensor.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/material/quadrature.h"

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kIndex = 1.5;
constexpr double kEntering = 1 - (kIndex - 1) * (kIndex - 1) / ((kIndex + 1) * (kIndex + 1));

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

const Quadrature& quadrature() {
  static const Quadrature rule = gauss_legendre(16);
  return rule;
}

/// Of the beam, where light first scatters, by mean free paths: as many for each share of the light, but
/// denser at the surface, which near the beam is all that counts, and far below, which far from it is.
struct FirstEvents {
  std::vector<double> depths, weights;
  FirstEvents() {
    for (std::size_t i = 0; i < quadrature().nodes.size(); ++i) {
      const double v = quadrature().nodes[i];  // v^2 (3 - 2 v) of the light scatters above
      depths.push_back(-std::log((1 - v) * (1 - v) * (1 + 2 * v)));
      weights.push_back(quadrature().weights[i] * 6 * v * (1 - v));
    }
  }
};

/// Angles between the surface at a point of it and the beam's point that light comes from, of those at which
/// light can leave: denser where that begins, as what leaves grows like a square root.
struct WaysOut {
  std::vector<double> cosines;  ///< to the normal
  std::vector<double> lengths;  ///< over the radius: down the beam and back up
  std::vector<double> weights;  ///< with the cosine and what is not reflected
  WaysOut() {
    const double least = std::acos(1 / kIndex), range = kPi / 2 - least;
    for (std::size_t i = 0; i < quadrature().nodes.size(); ++i) {
      const double v = quadrature().nodes[i], angle = least + range * v * v, cosine = std::sin(angle);
      cosines.push_back(cosine);
      lengths.push_back((1 + cosine) / std::cos(angle));
      weights.push_back(quadrature().weights[i] * 2 * v * range * cosine * (1 - reflectance_within(cosine)));
    }
  }
};

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
  static const FirstEvents events;
  const at::TensorOptions constant = radius.options().requires_grad(false);
  const at::Tensor depth = at::tensor(events.depths, constant) / extinction;
  const at::Tensor image_depth = depth + 4 * mismatch * diffusion;
  const at::Tensor square_radius = radius.square().unsqueeze(1);
  const at::Tensor distance = (square_radius + depth.square()).sqrt();
  const Source real(depth, distance, decay);
  const Source image(image_depth, (square_radius + image_depth.square()).sqrt(), decay);

  const at::Tensor exitance = (1 - 2 * first) / 4 / diffusion * (real.fluence - image.fluence) +
                              (1 - 3 * second) / 2 * (real.flux + image.flux);
  const at::Tensor correction = at::rsub((-2 * extinction * (distance + depth)).exp(), 1);
  const at::Tensor light = (exitance * correction).mv(at::tensor(events.weights, constant));
  return light * albedo.square() * (kEntering / (4 * kPi));
}

at::Tensor single_scattering(const Medium& medium, const at::Tensor& radius) {
  static const WaysOut ways;
  const at::TensorOptions constant = radius.options().requires_grad(false);
  const at::Tensor cosine = at::tensor(ways.cosines, constant);
  const at::Tensor path = radius.unsqueeze(1) * at::tensor(ways.lengths, constant);
  const at::Tensor g = medium.anisotropy, square_g = g.square();
  const at::Tensor base = 1 + square_g + 2 * g * cosine;
  const at::Tensor phase = at::rsub(square_g, 1) / (base * base.sqrt()) / (4 * kPi);
  const at::Tensor reached = (-(medium.scattering + medium.absorption) * path).exp();
  return reached.mv(phase * at::tensor(ways.weights, constant)) * medium.scattering / radius * kEntering;
}

}  // namespace patina
