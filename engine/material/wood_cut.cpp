#include "engine/material/wood_cut.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

namespace patina::wood {
namespace {

int period_of(const at::Tensor& noise, std::int64_t dim) {
  const int period = static_cast<int>(noise.size(dim)) - 1;
  assert(std::has_single_bit(static_cast<unsigned>(period)));
  return period;
}

}  // namespace

Cut::Cut(Numbers numbers, WoodNoise noise, double size_cm, std::int64_t n)
    : side_(n),
      numbers_(std::move(numbers)),
      noise_(std::move(noise)),
      values_(numbers_.values.begin(), numbers_.values.end()) {
  const auto place = [&](std::int64_t i) {
    return ((static_cast<double>(i) + 0.5) / static_cast<double>(n) - 0.5) * size_cm;
  };
  const double *centre = &numbers_.values[kCut], sine = centre[3], cosine = centre[4];
  for (std::int64_t i = 0; i <= n; ++i) {
    row_places_.push_back(place(i - 1));
    x_.push_back(static_cast<float>(centre[0] + place(i)));
    y_.push_back(static_cast<float>(centre[1] + sine * row_places_.back()));
    z_.push_back(static_cast<float>((centre[2] + cosine * row_places_.back()) * kAlongGrain));
  }
  ring_planes_ = planes_of(noise_.ring_widths, numbers_.ring_planes, kRingPlanes);
  streak_planes_ = planes_of(noise_.streaks, numbers_.streak_planes, numbers_.streak_weights());
}

noise::Warp Cut::gnarl(std::int64_t first_row) const {
  return {.volume = {noise_.distortion.data_ptr<float>(), period_of(noise_.distortion, 4)},
          .x = x_.data(),
          .y = y_.data() + first_row,
          .z = z_.data() + first_row,
          .columns = side_ + 1,
          .scale = values_[kGnarl],
          .amplitude = values_[kGnarl + 1]};
}

noise::Rings Cut::growth(const float* x, const float* y) const {
  const float* n = &values_[kGrowth];
  return {ring_planes_, x, y, n[0], n[1], n[2]};
}

noise::Streaks Cut::streaks(const float* x, const float* y) const {
  const float* n = &values_[kStreaks];
  return {streak_planes_, x, y, side_, n[0], n[1], n[2], n[3]};
}

Ring Cut::ring() const {
  const float* n = &values_[kRing];
  return {.end = n[0], .top = n[1], .rise = n[2], .fall = n[3], .mean = n[4]};
}

Contrast Cut::contrast() const {
  const float* n = &values_[kContrast];
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6], n[7], n[8]};
}

std::vector<noise::Plane> Cut::planes_of(const ValueNoise& noise, const std::vector<Level>& levels,
                                         std::size_t weight) const {
  std::vector<noise::Plane> planes;
  for (const Level& level : levels) {
    const at::Tensor& values = noise.levels[level.y][level.x];
    const auto axis = [&](std::int64_t dim, std::size_t of) {
      return noise::Axis{period_of(values, dim), std::ldexp(1.0F, -static_cast<int>(of))};
    };
    planes.push_back({values.data_ptr<float>(), axis(3, level.x), axis(2, level.y), values_[weight++]});
  }
  return planes;
}

}  // namespace patina::wood
