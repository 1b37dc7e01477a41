#pragma once

#include "engine/material/material.h"

namespace patina {

/// Metallic flakes under a clear coat (models.md "flake"): a smooth top coat, flakes with one slope each, and
/// below them either the paper's glow lobe, which has the share 1 - weight, or a diffuse base, or both.
class Flake final : public Material {
 public:
  static Signature signature();
  explicit Flake(ParameterTable table) : table_(std::move(table)) {}
  const ParameterTable& table() const override { return table_; }
  Tiling tiling() const override { return Tiling::map; }
  int oversampling() const override { return 2; }
  Surface surface(const ParameterTensors& parameters, std::span<const int> discrete, const Irregularities& z,
                  const Capture& capture, int resolution) const override;

 private:
  ParameterTable table_;
};

}  // namespace patina
