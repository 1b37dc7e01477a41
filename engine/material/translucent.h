#pragma once

#include "engine/material/material.h"

namespace patina {

/// A homogeneous translucent medium (paper section 6.1) lit by a point of light on its surface: the glow
/// around it. It has no irregularities. (1 - g) sigma_s is nearly all that a photo can tell; single
/// scattering tells a little more.
class Translucent final : public Material {
 public:
  static Signature signature();
  explicit Translucent(ParameterTable table) : table_(std::move(table)) {}
  const ParameterTable& table() const override { return table_; }
  Tiling tiling() const override { return Tiling::none; }
  /// base_color is apparent: what a diffuse surface would need to send as much light to the camera, had the
  /// flash lit all of it. It has no bound.
  Surface surface(const ParameterTensors& parameters, std::span<const int> discrete, const Irregularities& z,
                  const Capture& capture, int resolution) const override;

 private:
  ParameterTable table_;
};

}  // namespace patina
