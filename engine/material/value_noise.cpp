#include "engine/material/value_noise.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/grid_sampler_3d.h>
#include <ATen/ops/lerp.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/remainder.h>
#include <ATen/ops/stack.h>

#include <algorithm>
#include <cmath>

#include "engine/material/hash.h"

namespace patina {
namespace {

constexpr int kLinear = 0, kZeros = 0;
constexpr double kSharpness = -0.5;  // levels: linear interpolation blurs half a level by itself

at::Tensor uniform_values(std::uint64_t seed, std::uint64_t stream, at::IntArrayRef sizes) {
  at::Tensor values = at::empty(sizes, at::kFloat);
  float* value = values.data_ptr<float>();
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(values.numel()); ++i)
    value[i] = static_cast<float>(uniform_hash(seed, stream, i));
  return values;
}

/// Lattice coordinates as grid_sampler's with aligned corners, -1 to 1 over one period.
at::Tensor in_one_period(const at::Tensor& coordinate, std::int64_t size_with_repetition) {
  const auto period = static_cast<double>(size_with_repetition - 1);
  return at::remainder(coordinate, period) * (2 / period) - 1;
}

/// Where along the levels of one axis a width lies: between `level` and the next, by `share` ([], in [0,1]).
struct Place {
  std::size_t level;
  at::Tensor share;  ///< undefined: that level alone
};

Place place_of(const at::Tensor& width, std::size_t levels) {
  const at::Tensor level = width.log2() + kSharpness;
  const double at = level.item<double>();
  if (!(at > 0)) return {0, {}};
  if (at >= static_cast<double>(levels - 1)) return {levels - 1, {}};
  return {static_cast<std::size_t>(at), level - std::floor(at)};
}

/// @param x_level  runs of 2^x_level values lie at the middles of the runs
at::Tensor sample(const at::Tensor& values, const at::Tensor& x, const at::Tensor& y, std::size_t x_level,
                  std::size_t y_level) {
  const auto in_level = [](const at::Tensor& coordinate, std::size_t level) {
    const double run = std::exp2(static_cast<double>(level));
    return (coordinate - (run - 1) / 2) / run;
  };
  const at::Tensor grid = at::stack({in_one_period(in_level(x, x_level), values.size(3)),
                                     in_one_period(in_level(y, y_level), values.size(2))},
                                    -1);
  return at::grid_sampler_2d(values.to(grid.scalar_type()), grid.unsqueeze(0), kLinear, kZeros,
                             /*align_corners=*/true)[0][0];
}

at::Tensor mixed(const at::Tensor& finer, const Place& place, const auto& coarser) {
  return place.share.defined() ? at::lerp(finer, coarser(), place.share) : finer;
}

}  // namespace

ValueNoise make_value_noise(std::uint64_t seed, std::uint64_t stream, int rows, int columns) {
  ValueNoise noise;
  for (at::Tensor row = uniform_values(seed, stream, {1, 1, rows, columns});;
       row = at::avg_pool2d(row, {2, 1})) {
    noise.levels.emplace_back();
    for (at::Tensor level = row;; level = at::avg_pool2d(level, {1, 2})) {
      noise.levels.back().push_back(at::pad(level, {0, 1, 0, 1}, "circular"));
      if (level.size(3) == 1) break;
    }
    if (row.size(2) == 1) return noise;
  }
}

at::Tensor value_noise(const ValueNoise& noise, const at::Tensor& x, const at::Tensor& y,
                       const at::Tensor& width_x, const at::Tensor& width_y) {
  const Place column = place_of(width_x, noise.levels.front().size()),
              row = place_of(width_y, noise.levels.size());
  const auto at_level = [&](std::size_t j, std::size_t i) { return sample(noise.levels[j][i], x, y, i, j); };
  const auto at_row = [&](std::size_t j) {
    return mixed(at_level(j, column.level), column, [&] { return at_level(j, column.level + 1); });
  };
  return mixed(at_row(row.level), row, [&] { return at_row(row.level + 1); });
}

at::Tensor make_noise_volume(std::uint64_t seed, std::uint64_t stream, int channels, int period) {
  return at::pad(uniform_values(seed, stream, {1, channels, period, period, period}), {0, 1, 0, 1, 0, 1},
                 "circular");
}

at::Tensor volume_noise(const at::Tensor& volume, const at::Tensor& x, const at::Tensor& y,
                        const at::Tensor& z) {
  const std::int64_t size = volume.size(4);
  const at::Tensor grid =
      at::stack({in_one_period(x, size), in_one_period(y, size), in_one_period(z, size)}, -1);
  return at::grid_sampler_3d(volume.to(grid.scalar_type()), grid.view({1, 1, grid.size(0), grid.size(1), 3}),
                             kLinear, kZeros, /*align_corners=*/true)[0]
      .squeeze(1);
}

}  // namespace patina
