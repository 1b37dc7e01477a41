#include "engine/material/noise_look_up.h"

#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/material/noise_kernel.h"
#include "engine/material/pixel_blocks.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// @param levels  along x and along y, plane by plane
std::vector<noise::Plane> laid_out(const std::vector<at::Tensor>& values,
                                   const std::vector<std::int64_t>& levels, const at::Tensor& weights) {
  const float* weight = weights.data_ptr<float>();
  std::vector<noise::Plane> planes;
  for (std::size_t p = 0; p < values.size(); ++p) {
    const auto run = [&](std::size_t axis) {
      return std::ldexp(1.0F, static_cast<int>(levels[2 * p + axis]));
    };
    planes.push_back({values[p].data_ptr<float>(), static_cast<int>(values[p].size(2)) - 1,
                      static_cast<int>(values[p].size(3)) - 1, run(0), run(1), weight[p]});
  }
  return planes;
}

struct LookUpPlanes : torch::autograd::Function<LookUpPlanes> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& x, const at::Tensor& y,
                            const at::Tensor& weights, const std::vector<at::Tensor>& values,
                            const std::vector<std::int64_t>& levels) {
    const std::vector<noise::Plane> planes = laid_out(values, levels, weights);
    const at::Tensor sum = at::empty_like(x);
    over_blocks(x.numel(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      noise::look_up(planes, x.data_ptr<float>(), y.data_ptr<float>(), begin, end, sum.data_ptr<float>());
    });
    context->save_for_backward({x, y, weights});
    context->saved_data["values"] = values;
    context->saved_data["levels"] = levels;
    return sum;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &x = saved[0], &y = saved[1], &weights = saved[2];
    const std::vector<at::Tensor> values = context->saved_data["values"].toTensorVector();
    const std::vector<noise::Plane> planes =
        laid_out(values, context->saved_data["levels"].toIntVector(), weights);
    const at::Tensor gradient = outputs.front().contiguous();
    const at::Tensor by_x = at::empty_like(x), by_y = at::empty_like(y), by_weights = at::empty_like(weights);
    const std::vector<double> sums = sums_over_blocks(
        x.numel(), planes.size(), [&](std::int64_t begin, std::int64_t end, double* by_weight) {
          noise::look_up_backward(planes, x.data_ptr<float>(), y.data_ptr<float>(), begin, end,
                                  gradient.data_ptr<float>(), by_x.data_ptr<float>(), by_y.data_ptr<float>(),
                                  by_weight);
        });
    std::ranges::copy(sums, by_weights.data_ptr<float>());
    return {by_x, by_y, by_weights, {}, {}};
  }
};

noise::Volume laid_out(const at::Tensor& volume) {
  return {volume.data_ptr<float>(), static_cast<int>(volume.size(4)) - 1};
}

struct LookUpVolume : torch::autograd::Function<LookUpVolume> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& x, const at::Tensor& y,
                            const at::Tensor& z, const at::Tensor& volume) {
    const at::Tensor channels = at::empty({2, x.size(0), x.size(1)}, x.options());
    float* to = channels.data_ptr<float>();
    over_blocks(x.numel(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      noise::look_up(laid_out(volume), {x.data_ptr<float>(), y.data_ptr<float>(), z.data_ptr<float>()}, begin,
                     end, {to, to + x.numel()});
    });
    context->save_for_backward({x, y, z, volume});
    return channels;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &x = saved[0], &y = saved[1], &z = saved[2];
    const at::Tensor gradient = outputs.front().contiguous();
    const float* by_channel = gradient.data_ptr<float>();
    const at::Tensor by_x = at::empty_like(x), by_y = at::empty_like(y), by_z = at::empty_like(z);
    over_blocks(x.numel(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      noise::look_up_backward(laid_out(saved[3]),
                              {x.data_ptr<float>(), y.data_ptr<float>(), z.data_ptr<float>()}, begin, end,
                              {by_channel, by_channel + x.numel()},
                              {by_x.data_ptr<float>(), by_y.data_ptr<float>(), by_z.data_ptr<float>()});
    });
    return {by_x, by_y, by_z, {}};
  }
};

}  // namespace

at::Tensor look_up_planes(const std::vector<NoisePlane>& planes, const at::Tensor& x, const at::Tensor& y,
                          const at::Tensor& weights) {
  std::vector<at::Tensor> values;
  std::vector<std::int64_t> levels;
  for (const NoisePlane& plane : planes) {
    values.push_back(plane.values);
    levels.insert(levels.end(), {plane.x_level, plane.y_level});
  }
  return LookUpPlanes::apply(x.contiguous(), y.contiguous(), weights.contiguous(), values, levels);
}

at::Tensor look_up_volume(const at::Tensor& volume, const at::Tensor& x, const at::Tensor& y,
                          const at::Tensor& z) {
  return LookUpVolume::apply(x.contiguous(), y.contiguous(), z.contiguous(), volume);
}

}  // namespace patina
