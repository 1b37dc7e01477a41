#include "engine/material/value_noise.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/grid_sampler_3d.h>
#include <ATen/ops/ones_like.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/remainder.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/zeros_like.h>

#include <algorithm>
#include <cmath>

#include "engine/material/hash.h"

namespace patina {
namespace {

constexpr int kLinear = 0, kZeros = 0;

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

/// A level along one axis, and its share of what is seen ([], in [0,1]).
struct Share {
  std::size_t level;
  at::Tensor share;
};

/// The one or two levels that a width lies at or between.
std::vector<Share> shares_of(const at::Tensor& width, std::size_t levels) {
  const at::Tensor level = width.log2() + kLevelSharpness;
  const double at = level.item<double>();
  if (!(at > 0)) return {{0, at::ones_like(level)}};
  if (at >= static_cast<double>(levels - 1)) return {{levels - 1, at::ones_like(level)}};
  const auto finer = static_cast<std::size_t>(at);
  const at::Tensor coarser_share = level - std::floor(at);
  return {{finer, 1 - coarser_share}, {finer + 1, coarser_share}};
}

/// One level among those that are mixed: runs of 2^x_level by 2^y_level values.
struct NoisePlane {
  at::Tensor values;  ///< ValueNoise::levels[y_level][x_level]
  std::size_t x_level, y_level;
  at::Tensor weight;  ///< scalar
};

/// What is seen of noise at some widths: one or two levels along each axis.
std::vector<NoisePlane> mixture_of(const ValueNoise& noise, const at::Tensor& width_x,
                                   const at::Tensor& width_y) {
  std::vector<NoisePlane> planes;
  for (const Share& row : shares_of(width_y, noise.levels.size()))
    for (const Share& column : shares_of(width_x, noise.levels.front().size()))
      planes.push_back(
          {noise.levels[row.level][column.level], column.level, row.level, row.share * column.share});
  return planes;
}

at::Tensor sample(const NoisePlane& plane, const at::Tensor& x, const at::Tensor& y) {
  const auto in_level = [](const at::Tensor& coordinate, std::size_t level) {
    const double run = std::exp2(static_cast<double>(level));
    return (coordinate - (run - 1) / 2) / run;
  };
  const at::Tensor grid = at::stack({in_one_period(in_level(x, plane.x_level), plane.values.size(3)),
                                     in_one_period(in_level(y, plane.y_level), plane.values.size(2))},
                                    -1);
  return at::grid_sampler_2d(plane.values.to(grid.scalar_type()), grid.unsqueeze(0), kLinear, kZeros,
                             /*align_corners=*/true)[0][0];
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
  at::Tensor sum = at::zeros_like(x);
  for (const NoisePlane& plane : mixture_of(noise, width_x, width_y))
    sum = sum + plane.weight * sample(plane, x, y);
  return sum;
}

at::Tensor make_noise_volume(std::uint64_t seed, std::uint64_t stream, int channels, int period) {
  return at::pad(uniform_values(seed, stream, {1, channels, period, period, period}), {0, 1, 0, 1, 0, 1},
                 "circular");
}

WarpedGrid warp_grid(const at::Tensor& volume, const at::Tensor& x, const at::Tensor& y, const at::Tensor& z,
                     const at::Tensor& scale, const at::Tensor& amplitude) {
  const std::int64_t rows = y.numel(), columns = x.numel(), size = volume.size(4);
  const auto axis = [&](const at::Tensor& coordinate) {
    return in_one_period(coordinate * scale, size).expand({rows, columns});
  };
  const at::Tensor grid = at::stack({axis(x), axis(y.view({rows, 1})), axis(z.view({rows, 1}))}, -1);
  const at::Tensor moved =
      amplitude * at::grid_sampler_3d(volume.to(grid.scalar_type()), grid.view({1, 1, rows, columns, 3}),
                                      kLinear, kZeros, /*align_corners=*/true)[0]
                      .squeeze(1);
  return {x + moved[0], y.view({rows, 1}) + moved[1]};
}

}  // namespace patina
