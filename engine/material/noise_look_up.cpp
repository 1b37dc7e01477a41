#include "engine/material/noise_look_up.h"

#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/zeros_like.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/material/noise_kernel.h"
#include "engine/material/pixel_blocks.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

std::vector<at::Tensor> values_of(const NoiseMixture& noise) {
  std::vector<at::Tensor> values;
  for (const NoisePlane& plane : noise.planes) values.push_back(plane.values);
  return values;
}

/// Along x and along y, plane by plane.
std::vector<std::int64_t> levels_of(const NoiseMixture& noise) {
  std::vector<std::int64_t> levels;
  for (const NoisePlane& plane : noise.planes) levels.insert(levels.end(), {plane.x_level, plane.y_level});
  return levels;
}

/// @param levels  as levels_of() has them
std::vector<noise::Plane> laid_out(const std::vector<at::Tensor>& values,
                                   const std::vector<std::int64_t>& levels, const at::Tensor& weights) {
  const float* weight = weights.data_ptr<float>();
  std::vector<noise::Plane> planes;
  for (std::size_t p = 0; p < values.size(); ++p) {
    const auto axis = [&](int dim, std::size_t level) {
      return noise::Axis{static_cast<int>(values[p].size(dim)) - 1,
                         std::ldexp(1.0F, -static_cast<int>(levels[2 * p + level]))};
    };
    planes.push_back({values[p].data_ptr<float>(), axis(3, 0), axis(2, 1), weight[p]});
  }
  return planes;
}

/// @param growth  scale, amplitude, size
struct LookUpRings : torch::autograd::Function<LookUpRings> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& x, const at::Tensor& y,
                            const at::Tensor& growth, const at::Tensor& weights,
                            const std::vector<at::Tensor>& values, const std::vector<std::int64_t>& levels) {
    const noise::Rings rings = rings_of({x, y, growth, weights}, values, levels);
    const at::Tensor count = at::empty_like(x);
    over_blocks(x.numel(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      noise::rings(rings, begin, end, count.data_ptr<float>());
    });
    context->save_for_backward({x, y, growth, weights});
    context->saved_data["values"] = values;
    context->saved_data["levels"] = levels;
    return count;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const noise::Rings rings = rings_of(saved, context->saved_data["values"].toTensorVector(),
                                        context->saved_data["levels"].toIntVector());
    const at::Tensor gradient = outputs.front().contiguous();
    const at::Tensor by_x = at::empty_like(saved[0]), by_y = at::empty_like(saved[1]),
                     by_growth = at::empty_like(saved[2]), by_weights = at::empty_like(saved[3]);
    const std::vector<double> sums = sums_over_blocks(
        gradient.numel(), noise::kGrowthNumbers + rings.planes.size(),
        [&](std::int64_t begin, std::int64_t end, double* of_block) {
          noise::rings_backward(
              rings, begin, end, gradient.data_ptr<float>(),
              {by_x.data_ptr<float>(), by_y.data_ptr<float>(), of_block, of_block + noise::kGrowthNumbers});
        });
    std::copy_n(sums.begin(), noise::kGrowthNumbers, by_growth.data_ptr<float>());
    std::copy(sums.begin() + noise::kGrowthNumbers, sums.end(), by_weights.data_ptr<float>());
    return {by_x, by_y, by_growth, by_weights, {}, {}};
  }

 private:
  /// @param tensors  x, y, growth, weights
  static noise::Rings rings_of(const variable_list& tensors, const std::vector<at::Tensor>& values,
                               const std::vector<std::int64_t>& levels) {
    const float* growth = tensors[2].data_ptr<float>();
    return {laid_out(values, levels, tensors[3]),
            tensors[0].data_ptr<float>(),
            tensors[1].data_ptr<float>(),
            growth[0],
            growth[1],
            growth[2]};
  }
};

/// @param numbers  centre_x, centre_y, scale, power
struct LookUpStreaks : torch::autograd::Function<LookUpStreaks> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& x, const at::Tensor& y,
                            const at::Tensor& numbers, const at::Tensor& weights,
                            const std::vector<at::Tensor>& values, const std::vector<std::int64_t>& levels) {
    const noise::Streaks streaks = streaks_of({x, y, numbers, weights}, values, levels);
    const at::Tensor exponent = at::empty({streaks.side, streaks.side}, x.options());
    over_blocks(streaks.side, rows_of_a_block(streaks.side),
                [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                  noise::streaks(streaks, begin, end, exponent.data_ptr<float>());
                });
    context->save_for_backward({x, y, numbers, weights});
    context->saved_data["values"] = values;
    context->saved_data["levels"] = levels;
    return exponent;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const noise::Streaks streaks = streaks_of(saved, context->saved_data["values"].toTensorVector(),
                                              context->saved_data["levels"].toIntVector());
    const at::Tensor gradient = outputs.front().contiguous();
    const at::Tensor by_x = at::zeros_like(saved[0]), by_y = at::zeros_like(saved[1]),
                     by_numbers = at::empty_like(saved[2]), by_weights = at::empty_like(saved[3]);
    const std::vector<double> sums = sums_over_blocks(
        streaks.side, rows_of_a_block(streaks.side), noise::kStreakNumbers + streaks.planes.size(),
        [&](std::int64_t begin, std::int64_t end, double* of_block) {
          noise::streaks_backward(
              streaks, begin, end, gradient.data_ptr<float>(),
              {by_x.data_ptr<float>(), by_y.data_ptr<float>(), of_block, of_block + noise::kStreakNumbers});
        });
    std::copy_n(sums.begin(), noise::kStreakNumbers, by_numbers.data_ptr<float>());
    std::copy(sums.begin() + noise::kStreakNumbers, sums.end(), by_weights.data_ptr<float>());
    return {by_x, by_y, by_numbers, by_weights, {}, {}};
  }

 private:
  /// @param tensors  x, y, numbers, weights
  static noise::Streaks streaks_of(const variable_list& tensors, const std::vector<at::Tensor>& values,
                                   const std::vector<std::int64_t>& levels) {
    const float* numbers = tensors[2].data_ptr<float>();
    return {laid_out(values, levels, tensors[3]),
            tensors[0].data_ptr<float>(),
            tensors[1].data_ptr<float>(),
            tensors[0].size(1) - 1,
            numbers[0],
            numbers[1],
            numbers[2],
            numbers[3]};
  }
};

/// @param tensors  volume, x, y, z, scale, amplitude
noise::Warp warp_of(const variable_list& tensors) {
  const at::Tensor& volume = tensors[0];
  return {{volume.data_ptr<float>(), static_cast<int>(volume.size(4)) - 1},
          tensors[1].data_ptr<float>(),
          tensors[2].data_ptr<float>(),
          tensors[3].data_ptr<float>(),
          tensors[1].numel(),
          *tensors[4].data_ptr<float>(),
          *tensors[5].data_ptr<float>()};
}

struct LookUpWarp : torch::autograd::Function<LookUpWarp> {
  static variable_list forward(AutogradContext* context, const at::Tensor& volume, const at::Tensor& x,
                               const at::Tensor& y, const at::Tensor& z, const at::Tensor& scale,
                               const at::Tensor& amplitude) {
    const variable_list tensors{volume, x, y, z, scale, amplitude};
    const noise::Warp warp = warp_of(tensors);
    const at::Tensor moved_x = at::empty({y.numel(), x.numel()}, x.options()),
                     moved_y = at::empty_like(moved_x);
    over_blocks(y.numel(), rows_of_a_block(x.numel()),
                [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                  noise::warp(warp, begin, end, {moved_x.data_ptr<float>(), moved_y.data_ptr<float>()});
                });
    context->save_for_backward(tensors);
    return {moved_x, moved_y};
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &x = saved[1], &y = saved[2], &z = saved[3];
    const noise::Warp warp = warp_of(saved);
    const at::Tensor by_moved_x = outputs[0].contiguous(), by_moved_y = outputs[1].contiguous();
    const at::Tensor by_x = at::empty_like(x), by_y = at::empty_like(y), by_z = at::empty_like(z),
                     by_scale = at::empty_like(saved[4]), by_amplitude = at::empty_like(saved[5]);
    const auto columns = static_cast<std::size_t>(x.numel());
    const std::vector<double> sums = sums_over_blocks(
        y.numel(), rows_of_a_block(x.numel()), columns + 2,
        [&](std::int64_t begin, std::int64_t end, double* of_block) {
          std::vector<float> by_columns(columns);
          noise::warp_backward(
              warp, begin, end, {by_moved_x.data_ptr<float>(), by_moved_y.data_ptr<float>()},
              {by_columns.data(), by_y.data_ptr<float>(), by_z.data_ptr<float>(), of_block + columns});
          std::ranges::copy(by_columns, of_block);
        });
    std::copy_n(sums.begin(), columns, by_x.data_ptr<float>());
    *by_scale.data_ptr<float>() = static_cast<float>(sums[columns]);
    *by_amplitude.data_ptr<float>() = static_cast<float>(sums[columns + 1]);
    return {{}, by_x, by_y, by_z, by_scale, by_amplitude};
  }
};

}  // namespace

at::Tensor look_up_rings(const NoiseMixture& noise, const at::Tensor& x, const at::Tensor& y,
                         const at::Tensor& scale, const at::Tensor& amplitude, const at::Tensor& size) {
  return LookUpRings::apply(x.contiguous(), y.contiguous(), at::stack({scale, amplitude, size}),
                            noise.weights.contiguous(), values_of(noise), levels_of(noise));
}

at::Tensor look_up_streaks(const NoiseMixture& noise, const at::Tensor& x, const at::Tensor& y,
                           const at::Tensor& centre_x, const at::Tensor& centre_y, const at::Tensor& scale,
                           const at::Tensor& power) {
  return LookUpStreaks::apply(x.contiguous(), y.contiguous(), at::stack({centre_x, centre_y, scale, power}),
                              noise.weights.contiguous(), values_of(noise), levels_of(noise));
}

WarpedGrid look_up_warp(const at::Tensor& volume, const at::Tensor& x, const at::Tensor& y,
                        const at::Tensor& z, const at::Tensor& scale, const at::Tensor& amplitude) {
  const variable_list moved = LookUpWarp::apply(volume, x.contiguous(), y.contiguous(), z.contiguous(),
                                                scale.contiguous(), amplitude.contiguous());
  return {moved[0], moved[1]};
}

}  // namespace patina
