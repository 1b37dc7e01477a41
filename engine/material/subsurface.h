#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// A homogeneous scattering medium of refractive index 1.5 that fills the space below a plane.
struct Medium {
  at::Tensor scattering;  ///< sigma_s, scalar, 1/cm
  at::Tensor absorption;  ///< sigma_a, scalar, 1/cm
  at::Tensor anisotropy;  ///< g of the Henyey-Greenstein phase function, scalar, in (-1, 1)
};

/// What leaves the medium at a distance from a thin beam of unit power that enters it upright, per area. The
/// two parts are all of it.
///
/// Light scattered many times: photon beam diffusion (Habel, Christensen, Jarosz 2013), the dipole with
/// Grosjean's diffusion coefficient averaged over sources along the beam. Depends on scattering and
/// anisotropy by (1 - g) sigma_s alone (similarity theory).
/// @param radius  [k], cm, above 0   @return [k], 1/cm^2
at::Tensor multiple_scattering(const Medium& medium, const at::Tensor& radius);

/// Light scattered once, exactly, by equiangular quadrature along the beam (Habel et al. 2013, section 4;
/// Kulla, Fajardo 2012).
/// @param radius  [k], cm, above 0   @return [k], 1/cm^2
at::Tensor single_scattering(const Medium& medium, const at::Tensor& radius);

}  // namespace patina
