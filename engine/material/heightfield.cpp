#include "engine/material/heightfield.h"

#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/zeros_like.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <vector>

#include "engine/material/heightfield_kernel.h"
#include "engine/material/image_planes.h"
#include "engine/material/look_up.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// Heights beyond an image: of its other side, or there as well, in a row above and a column to the right.
enum class Border { periodic, open };

/// The rows of heights that belong to each row of n pixels.
class Rows {
 public:
  Rows(const at::Tensor& height, Border border)
      : data_(height.data_ptr<float>()),
        stride_(height.size(0)),
        open_(border == Border::open),
        n_(open_ ? stride_ - 1 : stride_),
        buffer_(open_ ? 0 : static_cast<std::size_t>(n_) + 1) {}

  std::int64_t n() const { return n_; }
  float* above(std::int64_t row) const { return data_ + (open_ ? row : (row + n_ - 1) % n_) * stride_; }

  /// n + 1 heights, until the next call.
  const float* here(std::int64_t row) {
    const float* heights = own(row);
    if (open_) return heights;
    std::copy_n(heights, n_, buffer_.begin());
    buffer_.back() = heights[0];
    return buffer_.data();
  }

  /// Calls f(to), which adds to n + 1 heights of a row.
  template <class F>
  void add_here(std::int64_t row, const F& f) {
    if (open_) return f(own(row));
    std::fill(buffer_.begin(), buffer_.end(), 0.0F);
    f(buffer_.data());
    buffer_.front() += buffer_.back();
    float* to = own(row);
    for (std::int64_t i = 0; i < n_; ++i) to[i] += buffer_[static_cast<std::size_t>(i)];
  }

 private:
  float* own(std::int64_t row) const { return data_ + (open_ ? row + 1 : row) * stride_; }

  float* data_;
  std::int64_t stride_;
  bool open_;
  std::int64_t n_;
  std::vector<float> buffer_;  ///< a periodic row and its first height again
};

/// Both kinds of normals in float32, one pass over the pixels each way. First derivatives only.
struct Normals : torch::autograd::Function<Normals> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& height, double pixel_cm,
                            Border border) {
    constexpr std::int64_t kRowsWorthAThread = 32;
    const std::int64_t n = Rows(height, border).n();
    const at::Tensor normal = at::empty({3, n, n}, height.options());
    const auto per_pixel = static_cast<float>(1 / pixel_cm);
    at::parallel_for(0, n, kRowsWorthAThread, [&](std::int64_t begin, std::int64_t end) {
      Rows rows(height, border);
      for (std::int64_t row = begin; row < end; ++row)
        normals_of_row(rows.above(row), rows.here(row), per_pixel, n, planes_at(normal, row));
    });
    context->save_for_backward({height});
    context->saved_data["pixel_cm"] = pixel_cm;
    context->saved_data["open"] = border == Border::open;
    return normal;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const at::Tensor height = context->get_saved_variables().front();
    const at::Tensor by_normal = outputs.front().contiguous(), by_height = at::zeros_like(height);
    const Border border = context->saved_data["open"].toBool() ? Border::open : Border::periodic;
    const auto per_pixel = static_cast<float>(1 / context->saved_data["pixel_cm"].toDouble());
    Rows rows(height, border), by_rows(by_height, border);
    for (std::int64_t row = 0; row < rows.n(); ++row) {
      const auto [x, y, z] = planes_at(by_normal, row);
      by_rows.add_here(row, [&, x = x, y = y, z = z](float* by_here) {
        normals_of_row_backward(rows.above(row), rows.here(row), per_pixel, rows.n(), {x, y, z},
                                by_rows.above(row), by_here);
      });
    }
    return {by_height, {}, {}};
  }

 private:
  static Planes planes_at(const at::Tensor& normal, std::int64_t row) {
    return from_pixel(planes_of(normal), row * normal.size(2));
  }
};

}  // namespace

at::Tensor heightfield_normals(const at::Tensor& height, double pixel_cm) {
  if (height.scalar_type() == at::kFloat)
    return Normals::apply(height.contiguous(), pixel_cm, Border::periodic);
  return heightfield_normals_by_tensors(height, pixel_cm);
}

at::Tensor heightfield_normals_by_tensors(const at::Tensor& height, double pixel_cm) {
  // The row above has the larger y.
  const std::int64_t n = height.size(0);
  return open_normals_by_tensors(
      at::pad(height.view({1, 1, n, n}), {0, 1, 1, 0}, "circular").view({n + 1, n + 1}), pixel_cm);
}

at::Tensor open_normals(const at::Tensor& height, double pixel_cm) {
  if (height.scalar_type() == at::kFloat) return Normals::apply(height.contiguous(), pixel_cm, Border::open);
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
