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

/// A grid, x of its columns, y and z of its rows, each of whose points moves along x and y by what a volume's
/// channels say at `scale` times where it is, times `amplitude`.
struct Warp {
  Volume volume;
  const float *x, *y, *z;
  std::ptrdiff_t columns;
  float scale, amplitude;
};

using Two = std::array<float*, 2>;
using ConstTwo = std::array<const float*, 2>;

/// Rows begin ... end - 1. @param to  x and y of all points, [rows, columns] each
void warp(const Warp& warp, std::ptrdiff_t begin, std::ptrdiff_t end, const Two& to);

struct WarpGradient {
  float* x;         ///< of columns; added to
  float *y, *z;     ///< of rows; written
  double* scalars;  ///< of scale and amplitude; added to
};

/// The gradient of a scalar that rows begin ... end - 1 make, few enough to add up in float32.
/// @param gradient  that by what warp() writes
void warp_backward(const Warp& warp, std::ptrdiff_t begin, std::ptrdiff_t end, const ConstTwo& gradient,
                   const WarpGradient& by);

}  // namespace patina::noise
