#pragma once

#include "engine/material/material.h"

namespace patina {

/// Plaster (models.md "plaster"): fractal noise cut off at a plateau, roughness that follows the noise.
class Plaster final : public Material {
 public:
  static Signature signature();
  explicit Plaster(ParameterTable table) : table_(std::move(table)) {}
  const ParameterTable& table() const override { return table_; }
  Tiling tiling() const override { return Tiling::map; }
  int oversampling() const override { return 2; }
  Surface surface(const ParameterTensors& parameters, std::span<const int> discrete, const Irregularities& z,
                  const Capture& capture, int resolution) const override;

 private:
  ParameterTable table_;
};

}  // namespace patina
