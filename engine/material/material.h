#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/material/capture.h"
#include "engine/material/irregularities.h"
#include "engine/material/parameter.h"
#include "engine/material/parameter_tensors.h"
#include "engine/material/surface.h"
#include "engine/material/tile.h"

namespace patina {

/// What the code of a material reads, in its order; its JSON file must say the same.
struct Signature {
  struct Choice {
    std::string_view name;
    int levels;
  };
  std::vector<std::string_view> parameters;
  std::vector<Choice> choices;
  std::vector<std::string_view> jagged = {};  ///< those of the parameters that are (Parameter::jagged)
  std::vector<std::string_view> places = {};  ///< those of the jagged ones that are (Parameter::place)
};

/// A procedural material: maps parameters and irregularities z to a surface. Implementations are
/// stateless after construction and safe to call from several threads.
class Material {
 public:
  virtual ~Material() = default;

  virtual const ParameterTable& table() const = 0;

  /// What of its surface repeats. Tiling::map: it has the parameters that whole_period() needs.
  virtual Tiling tiling() const = 0;

  /// Pixels a side, 1 or 2, to render for each that is compared with a photo, whose pixels are means over
  /// their area: above 1 where normals turn, and highlights with them, within a pixel of the sizes that are
  /// usual.
  virtual int oversampling() const { return 1; }

  /// @param parameters  as many as table().continuous, in parameter units
  /// @param discrete    a level for each of table().discrete
  /// @param z           the irregularities; the same z gives the same surface at any resolution
  /// @param resolution  n, pixels a side
  virtual Surface surface(const ParameterTensors& parameters, std::span<const int> discrete,
                          const Irregularities& z, const Capture& capture, int resolution) const = 0;
};

}  // namespace patina
