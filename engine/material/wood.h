#pragma once

#include "engine/material/material.h"

namespace patina {

/// Sawn wood (models.md "wood"; after Liu et al. 2016, "Simulating the structure and texture of solid wood"):
/// a plane cut through distorted growth rings around the z axis, dark latewood, fine streaks, one dielectric
/// lobe. Rings and streaks are averaged over each pixel.
class Wood final : public Material {
 public:
  static Signature signature();
  explicit Wood(ParameterTable table) : table_(std::move(table)) {}
  const ParameterTable& table() const override { return table_; }
  Tiling tiling() const override { return Tiling::book_matched; }
  int oversampling() const override { return 2; }
  Surface surface(const ParameterTensors& parameters, std::span<const int> discrete, const Irregularities& z,
                  const Capture& capture, int resolution) const override;

 private:
  ParameterTable table_;
};

}  // namespace patina
