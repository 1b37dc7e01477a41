#include "engine/material/heightfield.h"

#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/zeros_like.h>
#include <torch/csrc/autograd/custom_function.h>

#include "engine/material/heightfield_kernel.h"
#include "engine/material/look_up.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// open_normals() in float32, one pass over the pixels each way. First derivatives only.
struct OpenNormals : torch::autograd::Function<OpenNormals> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& height, double pixel_cm) {
    constexpr std::int64_t kRowsWorthAThread = 32;
    const std::int64_t n = height.size(-1) - 1;
    const at::Tensor normal = at::empty({3, n, n}, height.options());
    float* data = normal.data_ptr<float>();
    const auto per_pixel = static_cast<float>(1 / pixel_cm);
    at::parallel_for(0, n, kRowsWorthAThread, [&](std::int64_t begin, std::int64_t end) {
      normals_of_rows(height.data_ptr<float>(), per_pixel, n, begin, end,
                      {data, data + n * n, data + 2 * n * n});
    });
    context->save_for_backward({height});
    context->saved_data["pixel_cm"] = pixel_cm;
    return normal;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const at::Tensor height = context->get_saved_variables().front();
    const at::Tensor normal_gradient = outputs.front().contiguous();
    const std::int64_t n = height.size(-1) - 1;
    const at::Tensor gradient = at::zeros_like(height);
    const float* by_normal = normal_gradient.data_ptr<float>();
    normals_backward(height.data_ptr<float>(),
                     static_cast<float>(1 / context->saved_data["pixel_cm"].toDouble()), n,
                     {by_normal, by_normal + n * n, by_normal + 2 * n * n}, gradient.data_ptr<float>());
    return {gradient, {}};
  }
};

}  // namespace

at::Tensor heightfield_normals(const at::Tensor& height, double pixel_cm) {
  // The row above has the larger y.
  const std::int64_t n = height.size(0);
  return open_normals(at::pad(height.view({1, 1, n, n}), {0, 1, 1, 0}, "circular").view({n + 1, n + 1}),
                      pixel_cm);
}

at::Tensor open_normals(const at::Tensor& height, double pixel_cm) {
  if (height.scalar_type() == at::kFloat) return OpenNormals::apply(height.contiguous(), pixel_cm);
  return open_normals_by_tensors(height, pixel_cm);
}

at::Tensor open_normals_by_tensors(const at::Tensor& height, double pixel_cm) {
  const std::int64_t n = height.size(-1) - 1;
  const at::Tensor here = without_neighbours(height);
  const at::Tensor right = height.narrow(-2, 1, n).narrow(-1, 1, n),
                   above = height.narrow(-2, 0, n).narrow(-1, 0, n);
  const at::Tensor slope_x = (right - here) / pixel_cm, slope_y = (above - here) / pixel_cm;
  const at::Tensor z = (slope_x.square() + slope_y.square() + 1).rsqrt();
  return at::stack({-slope_x * z, -slope_y * z, z});
}

}  // namespace patina
