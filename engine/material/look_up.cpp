#include "engine/material/look_up.h"

#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/ones.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/remainder.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/zeros_like.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/material/mip_kernel.h"
#include "engine/material/pixel_blocks.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

constexpr std::int64_t kCoarsest = 8;  // texels a side
constexpr double kSharpness = -0.5;    // levels: bilinear interpolation blurs half a level by itself
constexpr std::int64_t kBorders = 2;   // texels, both sides together

std::int64_t texels(const at::Tensor& level) { return level.size(-1) - kBorders; }

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

/// One or two levels of a map, and their weights, [levels].
struct Mixture {
  std::vector<at::Tensor> levels;
  at::Tensor weights;
};

Mixture mixture_of(const MipMap& map, const at::Tensor& scale, std::int64_t n) {
  const at::Tensor texels_per_pixel =
      scale * (static_cast<double>(texels(map.finest())) / static_cast<double>(n));
  const at::Tensor level = texels_per_pixel.log2() + kSharpness;
  const double last = static_cast<double>(map.levels.size() - 1);
  const double at = std::clamp(level.item<double>(), 0.0, last);
  const auto finer = static_cast<std::size_t>(std::floor(at));
  if (at == static_cast<double>(finer))
    return {{map.levels[finer]}, at::ones({1}, scale.options().requires_grad(false))};
  const at::Tensor coarser = level - static_cast<double>(finer);
  return {{map.levels[finer], map.levels[finer + 1]}, at::stack({1 - coarser, coarser})};
}

/// look_up() in float32, one pass over the pixels each way. First derivatives only.
struct LookUp : torch::autograd::Function<LookUp> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& x, const at::Tensor& y,
                            const at::Tensor& weights, const std::vector<at::Tensor>& levels) {
    const mip::Problem problem = laid_out(x, y, weights, levels);
    const at::Tensor planes = at::empty({problem.channels, problem.rows(), problem.columns()}, x.options());
    at::parallel_for(0, problem.rows(), kRowsAtOnce, [&](std::int64_t begin, std::int64_t end) {
      mip::look_up(problem, begin, end, planes.data_ptr<float>());
    });
    context->save_for_backward({x, y, weights});
    context->saved_data["levels"] = levels;
    return planes;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const mip::Problem problem =
        laid_out(saved[0], saved[1], saved[2], context->saved_data["levels"].toTensorVector());
    const at::Tensor by_value = outputs.front().contiguous();
    const at::Tensor by_x = at::zeros_like(saved[0]), by_y = at::empty_like(saved[1]),
                     by_weights = at::zeros_like(saved[2]);
    // A block's sums stand for themselves until all are done: the total does not depend on the threads.
    std::vector<mip::Gradient> own(static_cast<std::size_t>(blocks_of(problem.rows(), kRowsAtOnce)),
                                   {std::vector<float>(problem.x.size()), by_y.data_ptr<float>(),
                                    std::vector<double>(problem.levels.size())});
    over_blocks(problem.rows(), kRowsAtOnce, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      mip::look_up_backward(problem, begin, end, by_value.data_ptr<float>(),
                            own[static_cast<std::size_t>(block)]);
    });
    for (std::size_t i = 0; i < problem.x.size(); ++i)
      by_x.data_ptr<float>()[i] = total(own, [i](const mip::Gradient& block) { return block.x[i]; });
    for (std::size_t l = 0; l < problem.levels.size(); ++l)
      by_weights.data_ptr<float>()[l] =
          total(own, [l](const mip::Gradient& block) { return block.weight[l]; });
    return {by_x, by_y, by_weights, {}};
  }

 private:
  static constexpr std::int64_t kRowsAtOnce = 16;

  static mip::Problem laid_out(const at::Tensor& x, const at::Tensor& y, const at::Tensor& weights,
                               const std::vector<at::Tensor>& levels) {
    const auto numbers = [](const at::Tensor& row) {
      const at::Tensor dense = row.contiguous();
      return std::vector<float>(dense.data_ptr<float>(), dense.data_ptr<float>() + dense.numel());
    };
    mip::Problem problem{{}, static_cast<int>(levels.front().size(1)), numbers(x), numbers(y)};
    const std::vector<float> weight = numbers(weights);
    for (std::size_t l = 0; l < levels.size(); ++l)
      problem.levels.push_back({levels[l].data_ptr<float>(), static_cast<int>(levels[l].size(2)), weight[l]});
    return problem;
  }

  template <class Part>
  static float total(const std::vector<mip::Gradient>& blocks, const Part& part) {
    double sum = 0;
    for (const mip::Gradient& block : blocks) sum += part(block);
    return static_cast<float>(sum);
  }
};

/// @param grid  [1, n, n, 2], texture coordinates
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
                   const at::Tensor& shift_y, int resolution, Neighbours neighbours) {
  if (scale.scalar_type() != at::kFloat)
    return look_up_by_tensors(map, scale, shift_x, shift_y, resolution, neighbours);
  const Place place = place_of(scale, shift_x, shift_y, resolution, neighbours);
  const Mixture mixture = mixture_of(map, scale, resolution);
  return LookUp::apply(place.x, place.y, mixture.weights, mixture.levels);
}

at::Tensor look_up_by_tensors(const MipMap& map, const at::Tensor& scale, const at::Tensor& shift_x,
                              const at::Tensor& shift_y, int resolution, Neighbours neighbours) {
  const Place place = place_of(scale, shift_x, shift_y, resolution, neighbours);
  const std::int64_t n = place.x.numel();
  const at::Tensor grid =
      at::stack({place.x.view({1, n}).expand({n, n}), place.y.view({n, 1}).expand({n, n})}, -1).unsqueeze(0) -
      1;
  const Mixture mixture = mixture_of(map, scale, resolution);
  at::Tensor sum = mixture.weights[0] * sample(mixture.levels[0], grid);
  if (mixture.levels.size() > 1) sum = sum + mixture.weights[1] * sample(mixture.levels[1], grid);
  return sum;
}

at::Tensor without_neighbours(const at::Tensor& planes) {
  const std::int64_t n = planes.size(-1) - 1;
  return planes.narrow(-2, 1, n).narrow(-1, 0, n);
}

}  // namespace patina
