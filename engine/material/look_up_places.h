#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/material/look_up.h"
#include "engine/material/mip_kernel.h"

namespace patina {

/// The binary logarithm of how many texels of the finest level lie in a pixel, less what bilinear
/// interpolation blurs by itself: the level to look up.
constexpr double kLevelOfATexelAPixel = -0.5;

/// The one or two levels of a map that a level lies at or between.
struct LevelShares {
  std::size_t finer;
  double coarser;  ///< how much of what is seen the next level has
};
LevelShares level_shares(double level, std::size_t levels);

/// A look-up (look_up.h) as loops over its pixels read it, and what its gradient needs.
class LookUpPlaces {
 public:
  /// @param scale, shift_x, shift_y  scalars, float32
  LookUpPlaces(const MipMap& map, const at::Tensor& scale, const at::Tensor& shift_x,
               const at::Tensor& shift_y, std::int64_t n, Neighbours neighbours);

  std::int64_t rows() const { return static_cast<std::int64_t>(y_.from_middle.size()); }
  mip::Problem problem() const { return problem(0, rows()); }
  /// Of rows begin ... end - 1 alone.
  mip::Problem problem(std::int64_t begin, std::int64_t end) const;

  /// Sums of a block of rows, 0.
  mip::Gradient no_gradient(float* by_rows) const;
  /// The gradient of a scalar by scale, shift_x and shift_y. @param blocks  sums of all   @param by_rows  of
  /// all
  std::array<double, 3> gradient(const std::vector<mip::Gradient>& blocks,
                                 const std::vector<float>& by_rows) const;

 private:
  /// Columns or rows.
  struct Axis {
    std::vector<double> from_middle;  ///< in the image and its shift, before `scale` stretches that
    std::vector<float> places;        ///< in [0, 2), one period
  };
  Axis axis(const at::Tensor& shift, std::int64_t n, std::int64_t first, std::int64_t count) const;

  double scale_;
  Axis x_, y_;
  std::vector<at::Tensor> levels_;
  std::vector<float> weights_;  ///< of the levels
};

}  // namespace patina
