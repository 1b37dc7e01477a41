#pragma once

#include <cstddef>

/// The finish of leather (leather_finish.h) in one pass over pixels, and its gradient.
namespace patina::leather {

/// LeatherRelief (leather_finish.h).
struct Relief {
  float height, power, noise_scale, roughness, roughness_variation;
};
constexpr std::size_t kReliefNumbers = 5;
constexpr float kLeastRoughness = 0.1F, kMostRoughness = 0.8F;

/// A grid of [side + 1, side + 1]; its pixels, [side, side], are those without its first row and last column.
struct Maps {
  const float *cells, *noise;
  std::ptrdiff_t side;
};

/// Rows begin ... end - 1 of the grid. @param height  of the grid   @param roughness  of the pixels
void finish(const Relief& relief, const Maps& maps, std::ptrdiff_t begin, std::ptrdiff_t end, float* height,
            float* roughness);

struct FinishGradient {
  float *cells, *noise;  ///< written
  double* relief;        ///< by its numbers, in their order; added to
};

/// The gradient of a scalar that rows begin ... end - 1 make, few enough to add up in float32.
/// @param by_height, by_roughness  that by what finish() wrote
void finish_backward(const Relief& relief, const Maps& maps, std::ptrdiff_t begin, std::ptrdiff_t end,
                     const float* by_height, const float* by_roughness, const FinishGradient& by);

}  // namespace patina::leather
