#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "engine/image.h"
#include "engine/material/capture.h"
#include "engine/material/maps.h"
#include "engine/material/parameter.h"

namespace patina {

/// Renders a material at given parameter values, without gradients. The door to the forward model for
/// callers that see no tensors (export, preview, command line). One thread at a time.
class Renderer {
 public:
  /// @throws UserError for an unknown material
  Renderer(const std::string& material, std::uint64_t z_seed, Capture capture);
  ~Renderer();

  const ParameterTable& table() const;  ///< with the priors for this capture

  /// The maps alone, as the preview shades them.
  /// @param resolution  pixels a side, 16 to 4096; UserError for any other
  MaterialMaps maps(const ParameterValues& values, int resolution) const;

  bool has_tile() const;  ///< whether anything of the material can repeat

  /// Maps that continue on the opposite side of each border, so that copies of them side by side show no
  /// seam. They may show more than the sample: their capture says how many centimetres.
  /// @param resolution  as in maps(); even, and 32 at least, of a material that is book-matched (tile.h)
  /// @throws UserError for any other, and for a material of which nothing can repeat
  MaterialMaps tile(const ParameterValues& values, int resolution) const;

  /// The maps under the capture light: 3 channels, display values in [0,1].
  Image render(const ParameterValues& values, int resolution, DisplayCurve curve = DisplayCurve::srgb) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace patina
