#include "engine/material/look_up.h"

#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/grid_sampler_2d.h>
#include <ATen/ops/lerp.h>
#include <ATen/ops/log2.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/remainder.h>
#include <ATen/ops/scalar_tensor.h>
#include <ATen/ops/stack.h>
#include <torch/csrc/autograd/custom_function.h>
#include <torch/custom_class.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

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

/// The level whose texels, interpolated, are as wide as the pixels; the finest is 0.
template <class Number>
Number level_of(const Number& texels_per_pixel) {
  using std::log2;
  return log2(texels_per_pixel) + kSharpness;
}

/// The one or two levels of a map that a level lies at or between.
struct Shares {
  std::size_t finer;
  double coarser;  ///< how much of what is seen the next level has
};

Shares shares_of(double level, std::size_t levels) {
  const double at = std::clamp(level, 0.0, static_cast<double>(levels - 1));
  const auto finer = static_cast<std::size_t>(std::floor(at));
  return {finer, at - static_cast<double>(finer)};
}

/// Where a look-up's columns or rows lie: in pixels and shifts, before `scale` stretches them.
struct Axis {
  std::vector<double> from_middle;

  Axis(double shift, std::int64_t n, std::int64_t first, std::int64_t count) {
    for (std::int64_t i = first; i < first + count; ++i)
      from_middle.push_back((static_cast<double>(i) + 0.5) * 2 / static_cast<double>(n) - 1 + shift);
  }

  /// In [0, 2), as place_of() has them.
  std::vector<float> places(double scale) const {
    std::vector<float> at;
    for (const double place : from_middle) {
      const double periods = (place * scale + 1) / 2;
      at.push_back(static_cast<float>(2 * (periods - std::floor(periods))));
    }
    return at;
  }
};

/// What is looked up, for the gradient.
struct LookUpPlaces : torch::CustomClassHolder {
  double scale;
  Axis x, y;
  std::vector<at::Tensor> levels;
  std::vector<float> weights;  ///< of the levels

  LookUpPlaces(const MipMap& map, double scale_, double shift_x, double shift_y, std::int64_t n,
               Neighbours neighbours)
      : scale(scale_), x(axis(shift_x, n, neighbours, 0)), y(axis(shift_y, n, neighbours, -1)) {
    const Shares shares =
        shares_of(level_of(scale * static_cast<double>(texels(map.finest())) / static_cast<double>(n)),
                  map.levels.size());
    levels.push_back(map.levels[shares.finer]);
    weights.push_back(static_cast<float>(1 - shares.coarser));
    if (shares.coarser == 0) return;
    levels.push_back(map.levels[shares.finer + 1]);
    weights.push_back(static_cast<float>(shares.coarser));
  }

  mip::Problem problem() const {
    mip::Problem problem{{}, static_cast<int>(levels.front().size(1)), x.places(scale), y.places(scale)};
    for (std::size_t l = 0; l < levels.size(); ++l)
      problem.levels.push_back(
          {levels[l].data_ptr<float>(), static_cast<int>(levels[l].size(2)), weights[l]});
    return problem;
  }

 private:
  /// @param first  where it begins if there are neighbours
  static Axis axis(double shift, std::int64_t n, Neighbours neighbours, std::int64_t first) {
    return neighbours == Neighbours::none ? Axis(shift, n, 0, n) : Axis(shift, n, first, n + 1);
  }
};

/// look_up() in float32, one pass over the pixels each way. First derivatives only.
struct LookUp : torch::autograd::Function<LookUp> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& scale, const at::Tensor& shift_x,
                            const at::Tensor& shift_y, const MipMap& map, std::int64_t n,
                            Neighbours neighbours) {
    const auto number = [](const at::Tensor& scalar) {
      return static_cast<double>(*scalar.data_ptr<float>());
    };
    const auto places = c10::make_intrusive<LookUpPlaces>(map, number(scale), number(shift_x),
                                                          number(shift_y), n, neighbours);
    const mip::Problem problem = places->problem();
    const at::Tensor planes =
        at::empty({problem.channels, problem.rows(), problem.columns()}, scale.options());
    at::parallel_for(0, problem.rows(), kRowsAtOnce, [&](std::int64_t begin, std::int64_t end) {
      mip::look_up(problem, begin, end, planes.data_ptr<float>());
    });
    context->saved_data["places"] = at::IValue::make_capsule(places);
    return planes;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const auto capsule = context->saved_data["places"].toCapsule();
    const auto& places = *static_cast<const LookUpPlaces*>(capsule.get());
    const mip::Problem problem = places.problem();
    const at::Tensor by_value = outputs.front().contiguous();
    // A block's sums stand for themselves until all are done: the total does not depend on the threads.
    std::vector<float> by_y(problem.y.size());
    std::vector<mip::Gradient> own(
        static_cast<std::size_t>(blocks_of(problem.rows(), kRowsAtOnce)),
        {std::vector<float>(problem.x.size()), by_y.data(), std::vector<double>(problem.levels.size())});
    over_blocks(problem.rows(), kRowsAtOnce, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      mip::look_up_backward(problem, begin, end, by_value.data_ptr<float>(),
                            own[static_cast<std::size_t>(block)]);
    });

    double by_scale = 0, by_shift_x = 0, by_shift_y = 0;
    for (const mip::Gradient& block : own) {
      add(block.x, places.x, by_scale, by_shift_x);
      // The coarser level's share is the binary logarithm of the scale, less a constant.
      if (block.weight.size() == 2)
        by_scale += (block.weight[1] - block.weight[0]) / (places.scale * std::numbers::ln2);
    }
    add(by_y, places.y, by_scale, by_shift_y);
    const auto scalar = [&](double value) { return at::scalar_tensor(value, by_value.options()); };
    return {
        scalar(by_scale), scalar(places.scale * by_shift_x), scalar(places.scale * by_shift_y), {}, {}, {}};
  }

 private:
  static constexpr std::int64_t kRowsAtOnce = 16;

  static void add(const std::vector<float>& by_place, const Axis& axis, double& by_scale, double& by_shift) {
    for (std::size_t i = 0; i < by_place.size(); ++i) {
      by_scale += static_cast<double>(by_place[i]) * axis.from_middle[i];
      by_shift += static_cast<double>(by_place[i]);
    }
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
      level_of<at::Tensor>(scale * (static_cast<double>(texels(map.finest())) / resolution));
  const Shares shares = shares_of(level.item<double>(), map.levels.size());
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
