#pragma once

#include <array>
#include <cstddef>
#include <vector>

/// Look-ups of value noise (value_noise.h) in one pass over pixels, and their gradients.
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
  std::vector<Plane> planes;
  const float *x, *y;
  float scale, amplitude, size;
};

/// Pixels begin ... end - 1.
void rings(const Rings& rings, std::ptrdiff_t begin, std::ptrdiff_t end, float* to);

constexpr std::size_t kGrowthNumbers = 3;

struct RingsGradient {
  float *x, *y;     ///< written
  double* growth;   ///< of scale, amplitude and size; added to
  double* weights;  ///< of planes; added to
};

/// The gradient of a scalar, given that by what rings() writes. Few enough pixels to add up in float32.
void rings_backward(const Rings& rings, std::ptrdiff_t begin, std::ptrdiff_t end, const float* gradient,
                    const RingsGradient& by);

/// 1 + power N(scale (x - centre_x), scale (y - centre_y)) of side x side pixels, which are those of a grid,
/// [side + 1, side + 1], without its first row and its last column.
struct Streaks {
  std::vector<Plane> planes;
  const float *x, *y;
  std::ptrdiff_t side;
  float centre_x, centre_y, scale, power;
};

/// Rows begin ... end - 1 of the pixels.
void streaks(const Streaks& streaks, std::ptrdiff_t begin, std::ptrdiff_t end, float* to);

constexpr std::size_t kStreakNumbers = 4;

struct StreaksGradient {
  float *x, *y;     ///< of the grid; written where pixels are
  double* numbers;  ///< of centre_x, centre_y, scale and power; added to
  double* weights;  ///< of planes; added to
};

/// The gradient of a scalar, given that by what streaks() writes. Few enough rows to add up in float32.
void streaks_backward(const Streaks& streaks, std::ptrdiff_t begin, std::ptrdiff_t end, const float* gradient,
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
