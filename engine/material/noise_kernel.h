#pragma once

#include <array>
#include <cstddef>
#include <span>

/// What wood_maps() reads of value noise (value_noise.h) in one pass over pixels, and the gradients.
namespace patina::noise {

/// Values along x or y: of how many they are the period, a power of two, and how many there are to a
/// coordinate. One lies at the middle of what it is the mean of, the first of which is 0.
struct Axis {
  int period;
  float per_coordinate;
};

/// A level of value noise: [y.period + 1, x.period + 1], the last row and column repeating the first.
struct Plane {
  const float* values;
  Axis x, y;
  float weight;
};

constexpr std::size_t kMostPlanes = 4;  ///< two levels along each axis

/// How many rings pixels are away from the pith: (r + amplitude N(scale r)) / size, r = sqrt(x^2 + y^2 +
/// kLeastSquare), N the weighted sum of planes of one row each.
struct Rings {
  static constexpr float kLeastSquare = 1e-6F;  ///< has a gradient at the pith
  std::span<const Plane> planes;
  const float *x, *y;
  float scale, amplitude, size;
};

void rings(const Rings& rings, std::ptrdiff_t pixels, float* to);

constexpr std::size_t kGrowthNumbers = 3;

struct RingsGradient {
  float *x, *y;     ///< added to
  double* growth;   ///< of scale, amplitude and size; added to
  double* weights;  ///< of planes; added to
};

/// The gradient of a scalar, given that by what rings() writes. Few enough pixels to add up in float32.
void rings_backward(const Rings& rings, std::ptrdiff_t pixels, const float* gradient,
                    const RingsGradient& by);

/// 1 + power N(scale (x - centre_x), scale (y - centre_y)) of rows of pixels, which are those of a grid,
/// [rows, side + 1], without its last column.
struct Streaks {
  std::span<const Plane> planes;
  const float *x, *y;  ///< of the grid
  std::ptrdiff_t side;
  float centre_x, centre_y, scale, power;
};

void streaks(const Streaks& streaks, std::ptrdiff_t rows, float* to);

constexpr std::size_t kStreakNumbers = 4;

struct StreaksGradient {
  float *x, *y;     ///< of the grid; added to
  double* numbers;  ///< of centre_x, centre_y, scale and power; added to
  double* weights;  ///< of planes; added to
};

/// The gradient of a scalar, given that by what streaks() writes. Few enough rows to add up in float32.
void streaks_backward(const Streaks& streaks, std::ptrdiff_t rows, const float* gradient,
                      const StreaksGradient& by);

/// Value noise in space: [2, period + 1, period + 1, period + 1], two channels, which repeat; the period is a
/// power of two.
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

/// @param to  x and y of all points, [rows, columns] each
void warp(const Warp& warp, std::ptrdiff_t rows, const Two& to);

struct WarpGradient {
  float* x;         ///< of columns; added to
  float *y, *z;     ///< of rows; written
  double* scalars;  ///< of scale and amplitude; added to
};

/// The gradient of a scalar, given that by what warp() writes. Few enough rows to add up in float32.
void warp_backward(const Warp& warp, std::ptrdiff_t rows, const ConstTwo& gradient, const WarpGradient& by);

}  // namespace patina::noise
