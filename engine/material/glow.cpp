#include "engine/material/glow.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/tensor.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

#include "engine/material/capture_view.h"
#include "engine/material/glow_kernel.h"
#include "engine/material/image_planes.h"
#include "engine/material/kept.h"
#include "engine/material/pixel_blocks.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

struct Reach {
  double nearest, farthest;  ///< pixels, cm from the beam
};

Reach reach(const Capture& capture, int n) {
  const auto from_beam = [](double offset) { return std::hypot(offset, offset, glow::kBeamRadius); };
  const double pixel = capture.size_cm / n;
  return {from_beam(n % 2 == 0 ? pixel / 2 : 0), from_beam((capture.size_cm - pixel) / 2)};
}

/// The upper left quarter of n x n pixels, the middle row and column included where there are such.
/// @param view  outlives the result
glow::Quarter quarter_of(const Capture& capture, const CaptureView& view) {
  const std::int64_t n = view.offset.numel();
  const Reach rings = reach(capture, static_cast<int>(n));
  return {view.offset.data_ptr<float>(), (n + 1) / 2, static_cast<float>(rings.nearest),
          static_cast<float>(rings.farthest), static_cast<float>(capture.camera_cm)};
}

struct Glow : torch::autograd::Function<Glow> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& log2_exitance, const Capture& capture,
                            std::int64_t n) {
    const CaptureView view = capture_view(capture, static_cast<int>(n), at::kFloat);
    const glow::Quarter quarter = quarter_of(capture, view);
    const at::Tensor rings = log2_exitance.contiguous(), color = at::empty({n, n}, rings.options());
    float* pixels = color.data_ptr<float>();
    over_blocks(quarter.side, rows_of_a_block(n), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t row = begin; row < end; ++row) {
        float *first = pixels + row * n, *middle = first + n / 2;
        glow::colors(quarter, row, rings.data_ptr<float>(), first);
        std::reverse_copy(first, middle, first + quarter.side);
        std::copy_n(first, n, pixels + (n - 1 - row) * n);
      }
    });
    context->save_for_backward({color});
    context->saved_data["capture"] = keep(capture);
    return color.expand({3, n, n});
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const at::Tensor color = context->get_saved_variables().front(), by_color = outputs.front().contiguous();
    const std::int64_t n = color.size(0);
    const auto& capture = kept<Capture>(context->saved_data["capture"]);
    const CaptureView view = capture_view(capture, static_cast<int>(n), at::kFloat);
    const glow::Quarter quarter = quarter_of(capture, view);
    const ConstPlanes by_planes = const_planes_of(by_color);
    const auto columns = static_cast<std::size_t>(quarter.side);
    const std::vector<double> by_log2 = sums_over_blocks(
        quarter.side, rows_of_a_block(n), glow::kRings,
        [&](std::int64_t begin, std::int64_t end, double* sums) {
          std::vector<std::int32_t> ring(columns);
          std::vector<float> share(columns), by_row(static_cast<std::size_t>(n));
          for (std::int64_t row = begin; row < end; ++row) {
            glow::places(quarter, row, ring.data(), share.data());
            glow::add_rows(by_planes, row, n - 1 - row, n, by_row.data());
            const float* pixels = color.data_ptr<float>() + row * n;
            for (std::size_t c = 0; c < columns; ++c) {
              const std::size_t opposite = by_row.size() - 1 - c;
              const float by = (by_row[c] + (opposite == c ? 0 : by_row[opposite])) * pixels[c],
                          outer = by * share[c];
              sums[ring[c]] += static_cast<double>(by - outer);
              sums[ring[c] + 1] += static_cast<double>(outer);
            }
          }
        });
    return {at::tensor(by_log2, color.options()) * std::log(2.0), {}, {}};
  }
};

}  // namespace

at::Tensor glow_rings(const Capture& capture, int n, const at::TensorOptions& options) {
  const Reach pixels = reach(capture, n);
  const at::Tensor share = at::arange(glow::kRings, options.requires_grad(false)) / (glow::kRings - 1);
  return pixels.nearest + (pixels.farthest - pixels.nearest) * share.square();
}

at::Tensor glow_color(const at::Tensor& log2_exitance, const Capture& capture, int n) {
  if (log2_exitance.scalar_type() != at::kFloat) return glow_color_by_tensors(log2_exitance, capture, n);
  return Glow::apply(log2_exitance, capture, static_cast<std::int64_t>(n));
}

at::Tensor glow_color_by_tensors(const at::Tensor& log2_exitance, const Capture& capture, int n) {
  const CaptureView view = capture_view(capture, n, log2_exitance.scalar_type());
  const Reach rings = reach(capture, n);
  const at::Tensor distance = (view.square_radius + glow::kBeamRadius * glow::kBeamRadius).sqrt();
  const at::Tensor share = ((distance - rings.nearest) / (rings.farthest - rings.nearest)).clamp(0, 1);
  const at::Tensor place = share.sqrt() * (glow::kRings - 1),
                   ring = place.floor().clamp_max(glow::kRings - 2);
  const at::Tensor first = ring.to(at::kLong).flatten();
  const auto at_rings = [&](const at::Tensor& index) {
    return log2_exitance.index_select(0, index).view({n, n});
  };
  const at::Tensor inner = at_rings(first), outer = at_rings(first + 1);
  const at::Tensor exitance = (inner + (place - ring) * (outer - inner)).exp2();
  const at::Tensor flash = view.direction[2] * view.inverse_square_distance;
  return (exitance / flash).expand({3, n, n});
}

}  // namespace patina
