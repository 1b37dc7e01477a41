#pragma once

#include "engine/material/material.h"

namespace patina {

/// Bumpy dielectric (models.md "bump"): a Gaussian-spectrum heightfield of random phases, one albedo, one GGX
/// lobe.
class Bump final : public Material {
 public:
  static Signature signature();
  explicit Bump(ParameterTable table) : table_(std::move(table)) {}
  const ParameterTable& table() const override { return table_; }
  Tiling tiling() const override { return Tiling::sample; }
  int oversampling() const override { return 2; }
  Surface surface(const ParameterTensors& parameters, std::span<const int> discrete, const Irregularities& z,
                  const Capture& capture, int resolution) const override;

 private:
  ParameterTable table_;
};

}  // namespace patina
