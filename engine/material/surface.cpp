#include "engine/material/surface.h"

#include <ATen/ops/full.h>

namespace patina {

Lobe dielectric_lobe(const at::Tensor& normal, const at::Tensor& roughness) {
  constexpr double kReflectance = 0.04;
  return {normal, at::full({1}, kReflectance, roughness.options().requires_grad(false)), roughness,
          roughness};
}

}  // namespace patina
