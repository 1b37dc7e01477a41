#pragma once

#include <cstddef>
#include <vector>

/// Bilinear look-ups of levels of a MipMap (look_up.h) at the points of an upright grid, in one pass over its
/// pixels, and their gradients.
namespace patina::mip {

/// A level with its border: [channels, side, side], of which the outermost texels repeat those of the other
/// side.
struct Level {
  const float* values;
  int side;
  float weight;
};

/// What is looked up: the weighted sum of levels, at most two, at columns x rows.
struct Problem {
  std::vector<Level> levels;
  int channels;             ///< at most kMostChannels
  std::vector<float> x, y;  ///< of columns and rows, in [0, 2), a period of the map
  std::ptrdiff_t columns() const { return static_cast<std::ptrdiff_t>(x.size()); }
  std::ptrdiff_t rows() const { return static_cast<std::ptrdiff_t>(y.size()); }
};

constexpr std::size_t kMostLevels = 2;
constexpr int kMostChannels = 4;

/// Rows begin ... end - 1. @param to  [channels, rows, columns]
void look_up(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, float* to);

struct Gradient {
  std::vector<float> x;        ///< of columns; added to
  float* y;                    ///< of rows; written
  std::vector<double> weight;  ///< of levels; added to
};

/// The gradient of a scalar that rows begin ... end - 1 make, few enough to add up in float32.
/// @param by_value  the gradient by what look_up() returns
void look_up_backward(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, const float* by_value,
                      Gradient& gradient);

}  // namespace patina::mip
