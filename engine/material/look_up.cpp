#include "engine/material/look_up.h"

#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/lerp.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/remainder.h>
#include <ATen/ops/scalar_tensor.h>
#include <ATen/ops/stack.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "engine/material/kept.h"
#include "engine/material/look_up_places.h"
#include "engine/material/pixel_blocks.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

constexpr std::int64_t kCoarsest = 8;  // texels a side
constexpr std::int64_t kBorders = 2;   // texels, both sides together

/// Texture coordinates of the columns and rows, plus one: in [0, 2), one period.
struct Place {
  at::Tensor x, y;
};

Place place_of(const at::Tensor& scale, const at::Tensor& shift_x, const at::Tensor& shift_y, std::int64_t n,
               Neighbours neighbours) {
  const bool more = neighbours == Neighbours::above_and_right;
  const at::Tensor pixel =
      at::arange(-1, n + 1, scale.options().requires_grad(false)).add(0.5) * (2.0 / static_cast<double>(n)) -
      1;
  const auto in_one_period = [&](const at::Tensor& pixels, const at::Tensor& shift) {
    return at::remainder((pixels + shift) * scale + 1, 2);
  };
  return {in_one_period(more ? pixel.narrow(0, 1, n + 1) : pixel.narrow(0, 1, n), shift_x),
          in_one_period(more ? pixel.narrow(0, 0, n + 1) : pixel.narrow(0, 1, n), shift_y)};
}

/// look_up() in float32, one pass over the pixels each way. First derivatives only.
struct LookUp : torch::autograd::Function<LookUp> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& scale, const at::Tensor& shift_x,
                            const at::Tensor& shift_y, const MipMap& map, std::int64_t n,
                            Neighbours neighbours) {
    LookUpPlaces places(map, scale, shift_x, shift_y, n, neighbours);
    const mip::Problem problem = places.problem();
    const at::Tensor planes =
        at::empty({problem.channels, problem.rows(), problem.columns()}, scale.options());
    at::parallel_for(0, problem.rows(), kRowsAtOnce, [&](std::int64_t begin, std::int64_t end) {
      mip::look_up(problem, begin, end, planes.data_ptr<float>());
    });
    context->saved_data["places"] = keep(std::move(places));
    return planes;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const auto& places = kept<LookUpPlaces>(context->saved_data["places"]);
    const mip::Problem problem = places.problem();
    const at::Tensor by_value = outputs.front().contiguous();
    // A block's sums stand for themselves until all are done: the total does not depend on the threads.
    std::vector<float> by_rows(problem.y.size());
    std::vector<mip::Gradient> blocks(static_cast<std::size_t>(blocks_of(problem.rows(), kRowsAtOnce)),
                                      places.no_gradient(by_rows.data()));
    over_blocks(problem.rows(), kRowsAtOnce, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      mip::look_up_backward(problem, begin, end, by_value.data_ptr<float>(),
                            blocks[static_cast<std::size_t>(block)]);
    });
    variable_list gradient;
    for (const double by_number : places.gradient(blocks, by_rows))
      gradient.push_back(at::scalar_tensor(by_number, by_value.options()));
    gradient.resize(6);  // nothing for what are no tensors
    return gradient;
  }

 private:
  static constexpr std::int64_t kRowsAtOnce = 16;
};

/// @param grid  [1, n, n, 2], texture coordinates
at::Tensor sample(const at::Tensor& level, const at::Tensor& grid) {
  constexpr int kBilinear = 0, kZeros = 0;
  const double m = static_cast<double>(period_of(level)), inside = m / (m + kBorders);
  return at::grid_sampler_2d(level.to(grid.scalar_type()), grid * inside, kBilinear, kZeros,
                             /*align_corners=*/false)[0];
}

}  // namespace

std::int64_t period_of(const at::Tensor& level) { return level.size(-1) - kBorders; }

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
                   const at::Tensor& shift_y, int resolution, Neighbours neighbours) {
  if (scale.scalar_type() != at::kFloat)
    return look_up_by_tensors(map, scale, shift_x, shift_y, resolution, neighbours);
  return LookUp::apply(scale, shift_x, shift_y, map, static_cast<std::int64_t>(resolution), neighbours);
}

at::Tensor look_up_by_tensors(const MipMap& map, const at::Tensor& scale, const at::Tensor& shift_x,
                              const at::Tensor& shift_y, int resolution, Neighbours neighbours) {
  const Place place = place_of(scale, shift_x, shift_y, resolution, neighbours);
  const std::int64_t n = place.x.numel();
  const at::Tensor grid =
      at::stack({place.x.view({1, n}).expand({n, n}), place.y.view({n, 1}).expand({n, n})}, -1).unsqueeze(0) -
      1;
  const at::Tensor level =
      (scale * (static_cast<double>(period_of(map.finest())) / resolution)).log2() + kLevelOfATexelAPixel;
  const LevelShares shares = level_shares(level.item<double>(), map.levels.size());
  const at::Tensor finer = sample(map.levels[shares.finer], grid);
  if (shares.coarser == 0) return finer;
  return at::lerp(finer, sample(map.levels[shares.finer + 1], grid),
                  level - static_cast<double>(shares.finer));
}

at::Tensor without_neighbours(const at::Tensor& planes) {
  const std::int64_t n = planes.size(-1) - 1;
  return planes.narrow(-2, 1, n).narrow(-1, 0, n);
}

}  // namespace patina
