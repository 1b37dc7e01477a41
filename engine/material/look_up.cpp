#include "engine/material/look_up.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/lerp.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/remainder.h>
#include <ATen/ops/stack.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patina {
namespace {

constexpr std::int64_t kCoarsest = 8;  // texels a side
constexpr double kSharpness = -0.5;    // levels: bilinear interpolation blurs half a level by itself
constexpr std::int64_t kBorders = 2;   // texels, both sides together

std::int64_t texels(const at::Tensor& level) { return level.size(-1) - kBorders; }

/// Texture coordinates of n + 1 pixels in a row, in one period.
at::Tensor texture_coordinates(const at::Tensor& pixels, const at::Tensor& shift, const at::Tensor& scale) {
  return at::remainder((pixels + shift) * scale + 1, 2) - 1;
}

/// @param grid  [1, n + 1, n + 1, 2], texture coordinates
at::Tensor sample(const at::Tensor& level, const at::Tensor& grid) {
  constexpr int kBilinear = 0, kZeros = 0;
  const double m = static_cast<double>(texels(level)), inside = m / (m + kBorders);
  return at::grid_sampler_2d(level.to(grid.scalar_type()), grid * inside, kBilinear, kZeros,
                             /*align_corners=*/false)[0];
}

}  // namespace

MipMap make_mip_map(const at::Tensor& map) {
  assert(map.dim() == 4 && map.size(2) == map.size(3) && map.size(2) >= 2 * kCoarsest);
  MipMap mips;
  for (at::Tensor level = map;; level = at::avg_pool2d(level, {2, 2})) {
    mips.levels.push_back(at::pad(level, {1, 1, 1, 1}, "circular"));
    if (level.size(2) <= kCoarsest) return mips;
  }
}

MipMap stack_channels(const MipMap& first, const MipMap& second) {
  assert(first.levels.size() == second.levels.size());
  MipMap both;
  for (std::size_t i = 0; i < first.levels.size(); ++i)
    both.levels.push_back(at::cat({first.levels[i], second.levels[i]}, 1));
  return both;
}

at::Tensor look_up(const MipMap& map, const at::Tensor& scale, const at::Tensor& shift_x,
                   const at::Tensor& shift_y, int resolution) {
  const std::int64_t n = resolution;
  const at::Tensor pixel =
      at::arange(-1, n + 1, scale.options().requires_grad(false)).add(0.5) * (2.0 / n) - 1;
  const at::Tensor x = texture_coordinates(pixel.narrow(0, 1, n + 1), shift_x, scale);
  const at::Tensor y = texture_coordinates(pixel.narrow(0, 0, n + 1), shift_y, scale);
  const at::Tensor grid =
      at::stack({x.view({1, n + 1}).expand({n + 1, n + 1}), y.view({n + 1, 1}).expand({n + 1, n + 1})}, -1)
          .unsqueeze(0);

  const at::Tensor texels_per_pixel = scale * (static_cast<double>(texels(map.finest())) / n);
  const at::Tensor level = texels_per_pixel.log2() + kSharpness;
  const double last = static_cast<double>(map.levels.size() - 1);
  const double at = std::clamp(level.item<double>(), 0.0, last);
  const auto finer = static_cast<std::size_t>(std::floor(at));
  const at::Tensor sharp = sample(map.levels[finer], grid);
  if (at == static_cast<double>(finer)) return sharp;
  return at::lerp(sharp, sample(map.levels[finer + 1], grid), level - static_cast<double>(finer));
}

at::Tensor without_neighbours(const at::Tensor& planes) {
  const std::int64_t n = planes.size(-1) - 1;
  return planes.narrow(-2, 1, n).narrow(-1, 0, n);
}

}  // namespace patina
