#pragma once

#include "engine/material/material.h"

namespace patina {

/// Leather (models.md "leather"): Voronoi cells raised by a power, fractal noise on top, roughness that
/// follows the cells.
class Leather final : public Material {
 public:
  static Signature signature();
  explicit Leather(ParameterTable table) : table_(std::move(table)) {}
  const ParameterTable& table() const override { return table_; }
  Tiling tiling() const override { return Tiling::map; }
  int oversampling() const override { return 2; }
  Surface surface(const ParameterTensors& parameters, std::span<const int> discrete, const Irregularities& z,
                  const Capture& capture, int resolution) const override;

 private:
  ParameterTable table_;
};

}  // namespace patina
