#pragma once

#include <ATen/core/Tensor.h>
#include <ATen/ops/tensor.h>

#include <memory>
#include <random>
#include <vector>

#include "engine/material/material.h"
#include "engine/material/photograph.h"
#include "engine/material/registry.h"

namespace patina {

/// Irregularities that a whole test program shares, so that their maps are made once.
inline const Irregularities& shared_irregularities() {
  static const Irregularities z(11);
  return z;
}

inline at::Tensor tensor_of(const std::vector<double>& values, at::ScalarType type) {
  return at::tensor(values, at::kDouble).to(type);
}

/// Uniform in the middle 80 % of each prior's box.
inline std::vector<double> inside_box(const ParameterTable& table, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.1, 0.9);
  std::vector<double> values;
  for (const Parameter& parameter : table.continuous)
    values.push_back(parameter.prior.low + share(random) * (parameter.prior.high - parameter.prior.low));
  return values;
}

/// The whole forward model: [3, n, n] in [0,1], in the type of `parameters`.
inline at::Tensor render(const Material& material, const at::Tensor& parameters,
                         const std::vector<int>& discrete, int resolution,
                         DisplayCurve curve = DisplayCurve::srgb,
                         const Irregularities& z = shared_irregularities()) {
  const Capture capture;
  return photograph(material.surface(parameters, discrete, z, capture, resolution), capture, resolution,
                    curve);
}

}  // namespace patina
