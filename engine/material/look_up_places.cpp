#include "engine/material/look_up_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/material/parameter_tensors.h"

namespace patina {

LevelShares level_shares(double level, std::size_t levels) {
  if (!(level > 0)) return {0, 0};
  const double at = std::min(level, static_cast<double>(levels - 1));
  const auto finer = static_cast<std::size_t>(std::floor(at));
  return {finer, at - static_cast<double>(finer)};
}

LookUpPlaces::LookUpPlaces(const MipMap& map, const at::Tensor& scale, const at::Tensor& shift_x,
                           const at::Tensor& shift_y, std::int64_t n, Neighbours neighbours)
    : scale_(number_of(scale)) {
  const bool more = neighbours == Neighbours::above_and_right;
  x_ = axis(shift_x, n, 0, more ? n + 1 : n);
  y_ = axis(shift_y, n, more ? -1 : 0, more ? n + 1 : n);
  const double texels_per_pixel =
      scale_ * static_cast<double>(period_of(map.finest())) / static_cast<double>(n);
  const LevelShares shares =
      level_shares(std::log2(texels_per_pixel) + kLevelOfATexelAPixel, map.levels.size());
  levels_.push_back(map.levels[shares.finer]);
  weights_.push_back(static_cast<float>(1 - shares.coarser));
  if (shares.coarser == 0) return;
  levels_.push_back(map.levels[shares.finer + 1]);
  weights_.push_back(static_cast<float>(shares.coarser));
}

LookUpPlaces::Axis LookUpPlaces::axis(const at::Tensor& shift, std::int64_t n, std::int64_t first,
                                      std::int64_t count) const {
  Axis axis;
  for (std::int64_t i = first; i < first + count; ++i) {
    const double from_middle =
        (static_cast<double>(i) + 0.5) * 2 / static_cast<double>(n) - 1 + number_of(shift);
    const double periods = (from_middle * scale_ + 1) / 2;
    axis.from_middle.push_back(from_middle);
    axis.places.push_back(static_cast<float>(2 * (periods - std::floor(periods))));
  }
  return axis;
}

mip::Problem LookUpPlaces::problem(std::int64_t begin, std::int64_t end) const {
  mip::Problem problem{{},
                       static_cast<int>(levels_.front().size(1)),
                       x_.places,
                       {y_.places.begin() + begin, y_.places.begin() + end}};
  for (std::size_t l = 0; l < levels_.size(); ++l)
    problem.levels.push_back(
        {levels_[l].data_ptr<float>(), static_cast<int>(levels_[l].size(2)), weights_[l]});
  return problem;
}

mip::Gradient LookUpPlaces::no_gradient(float* by_rows) const {
  return {std::vector<float>(x_.from_middle.size()), by_rows, std::vector<double>(levels_.size())};
}

std::array<double, 3> LookUpPlaces::gradient(const std::vector<mip::Gradient>& blocks,
                                             const std::vector<float>& by_rows) const {
  double by_scale = 0;
  const auto along = [&](const std::vector<float>& by_place, const Axis& axis) {
    double by_shift = 0;
    for (std::size_t i = 0; i < by_place.size(); ++i) {
      by_scale += static_cast<double>(by_place[i]) * axis.from_middle[i];
      by_shift += static_cast<double>(by_place[i]);
    }
    return scale_ * by_shift;
  };
  double by_shift_x = 0;
  for (const mip::Gradient& block : blocks) {
    by_shift_x += along(block.x, x_);
    // The coarser level's share is the binary logarithm of the scale, less a constant.
    if (levels_.size() == 2) by_scale += (block.weight[1] - block.weight[0]) / (scale_ * std::numbers::ln2);
  }
  const double by_shift_y = along(by_rows, y_);
  return {by_scale, by_shift_x, by_shift_y};
}

}  // namespace patina
