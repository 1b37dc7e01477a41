#pragma once

#include "engine/material/material.h"

namespace patina {

/// Brushed metal (models.md "metal"): a Gaussian heightfield with a spectrum of its own along each axis and
/// one anisotropic, coloured GGX lobe; no diffuse base.
class Metal final : public Material {
 public:
  static Signature signature();
  explicit Metal(ParameterTable table) : table_(std::move(table)) {}
  const ParameterTable& table() const override { return table_; }
  Tiling tiling() const override { return Tiling::sample; }
  Surface surface(const ParameterTensors& parameters, std::span<const int> discrete, const Irregularities& z,
                  const Capture& capture, int resolution) const override;

 private:
  ParameterTable table_;
};

}  // namespace patina
