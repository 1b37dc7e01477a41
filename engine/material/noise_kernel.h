#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// Look-ups of value noise (value_noise.h) in one pass over pixels, and their gradients.
namespace patina::noise {

/// A level of value noise: values of runs of `run_x` by `run_y` coordinates, at the middles of the runs;
/// [rows + 1, columns + 1], the last row and column repeating the first.
struct Plane {
  const float* values;
  int rows, columns;
  float run_x, run_y, weight;
};

constexpr std::size_t kMostPlanes = 4;  ///< two levels along each axis

/// Pixels begin ... end - 1 of the weighted sum of planes. @param x, y  lattice coordinates
void look_up(const std::vector<Plane>& planes, const float* x, const float* y, std::ptrdiff_t begin,
             std::ptrdiff_t end, float* to);

/// Writes the gradient of a scalar by x and y, given that by the sum, and adds to that by the weights. Few
/// enough pixels to add up in float32.
void look_up_backward(const std::vector<Plane>& planes, const float* x, const float* y, std::ptrdiff_t begin,
                      std::ptrdiff_t end, const float* gradient, float* by_x, float* by_y, double* by_weight);

/// Value noise in space: [2, period + 1, period + 1, period + 1], two channels, which repeat.
struct Volume {
  const float* values;
  int period;
};

using Two = std::array<float*, 2>;
using Three = std::array<float*, 3>;
using ConstTwo = std::array<const float*, 2>;
using ConstThree = std::array<const float*, 3>;

/// @param place  x, y and z   @param to  the two channels
void look_up(const Volume& volume, const ConstThree& place, std::ptrdiff_t begin, std::ptrdiff_t end,
             const Two& to);

/// Writes the gradient of a scalar by the place, given that by both channels.
void look_up_backward(const Volume& volume, const ConstThree& place, std::ptrdiff_t begin, std::ptrdiff_t end,
                      const ConstTwo& gradient, const Three& by_place);

}  // namespace patina::noise
