#pragma once

#include <ATen/core/Tensor.h>

#include <vector>

namespace patina {

/// One microfacet lobe, GGX without shadowing: F0 D(c) / (4 c^2), alpha = roughness^2.
struct Lobe {
  at::Tensor normal;  ///< [3, n, n] unit vectors
  at::Tensor
      f0;  ///< [1], [3] or [3, n, n], linear RGB reflectance at normal incidence (lobe weight included)
  at::Tensor roughness_x;  ///< [n, n] or scalar
  at::Tensor roughness_y;  ///< the same tensor as roughness_x where the lobe is isotropic
};

/// The isotropic, colourless lobe of refractive index 1.5: F0 = 0.04.
Lobe dielectric_lobe(const at::Tensor& normal, const at::Tensor& roughness);

/// What a material makes of its parameters before light falls on it. Float32, differentiable.
struct Surface {
  at::Tensor base_color;  ///< [3, n, n] or [3, 1, 1], linear RGB diffuse albedo
  at::Tensor height;      ///< [n, n], cm
  at::Tensor normal;      ///< [3, n, n], the diffuse normal
  std::vector<Lobe> lobes;
  at::Tensor light;           ///< scalar, intensity
  at::Tensor vignette_sigma;  ///< scalar, cm (parameter iSigma)
};

}  // namespace patina
