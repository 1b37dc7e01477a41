#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/material/capture.h"
#include "engine/material/planes.h"

namespace patina {

/// One number a pixel, or one for all of them.
struct Field {
  const float* data;
  bool uniform;
};

/// Where a kernel puts the derivative by a Field: a plane, or a sum where the field is uniform; nullptr where
/// nobody asks.
struct FieldGradient {
  float* plane = nullptr;
  double* sum = nullptr;
};

/// Where a lobe's numbers lie among the fields: the first of three of normal and f0. They are its own, but
/// for a normal that may be the surface's.
struct LobeFields {
  std::size_t normal, f0, roughness_x, roughness_y;
  constexpr bool isotropic() const { return roughness_x == roughness_y; }
  bool operator==(const LobeFields&) const = default;
};

/// A surface and the light on it as flat arrays of side x side pixels, for shade() and display() (shading.h)
/// in one pass without a tensor in between.
struct ShadingProblem {
  std::ptrdiff_t side;
  const float* offset;            ///< of `side` columns and, negated, rows (CaptureView)
  const float* inverse_distance;  ///< the rest of a view follows by arithmetic, which is faster than memory
  float camera_cm;
  float light, vignette_sigma;
  DisplayCurve curve;
  static constexpr std::size_t kBaseColor = 0, kNormal = 3, kLobes = 6;
  std::vector<Field> fields;  ///< base_color, normal, then what the lobes point at
  std::vector<LobeFields> lobes;
};

constexpr std::size_t kMostFields = 48;

struct ShadingGradient {
  std::vector<FieldGradient> fields;  ///< as ShadingProblem::fields
  double light = 0, vignette_sigma = 0;
};

/// Rows begin ... end - 1 of display(shade(surface)).
void shade_pixels(const ShadingProblem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                  const Planes& image);

/// The gradient of a scalar by everything in the problem, given that by rows of the image: planes are
/// written, sums added to.
/// @param image  what shade_pixels() made: the display curve's slope follows from its value without a power
void shade_pixels_backward(const ShadingProblem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                           const ConstPlanes& image, const ConstPlanes& image_gradient,
                           ShadingGradient& gradient);

}  // namespace patina
