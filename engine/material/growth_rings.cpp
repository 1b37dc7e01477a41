#include "engine/material/growth_rings.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/clamp.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/hardtanh.h>
#include <ATen/ops/lerp.h>
#include <ATen/ops/minimum.h>
#include <ATen/ops/ones_like.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/zeros_like.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <vector>

#include "engine/material/pixel_blocks.h"
#include "engine/material/wood_kernel.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// The integral of q from the beginning of a ring on. With the ramps' top m (below 1 where they meet before
/// it),
///   q = m (clamp(t / (m a), 0, 1) + clamp((e - t) / (m b), 0, 1) - 1),  e = latewood_fraction + b,
/// a trapezoid, for which the integral of each term is a parabola and a straight line.
class RingIntegral {
 public:
  explicit RingIntegral(const RingProfile& profile)
      : end_(profile.latewood_fraction + profile.latewood_ramp),
        top_((end_ / (profile.earlywood_ramp + profile.latewood_ramp)).clamp_max(1)),
        rise_(top_ * profile.earlywood_ramp),
        fall_(top_ * profile.latewood_ramp),
        whole_ring_(within_ring(at::ones_like(end_))) {}

  at::Tensor operator()(const at::Tensor& rings) const {
    const at::Tensor before = rings.detach().floor();
    return before * whole_ring_ + within_ring(rings - before);
  }

  const at::Tensor& whole_ring() const { return whole_ring_; }

  /// [5], as wood::Ring has them.
  at::Tensor numbers() const { return at::stack({end_, top_, rise_, fall_, whole_ring_}); }

 private:
  at::Tensor within_ring(const at::Tensor& t) const {
    const at::Tensor rising = at::minimum(t, rise_);
    const at::Tensor falling = at::clamp((t - (end_ - fall_)), at::zeros_like(fall_), fall_);
    const at::Tensor after = (t - end_).clamp_min(0);
    return top_ * (rising.square() / (2 * rise_) - rising + t - falling.square() / (2 * fall_) - after);
  }

  at::Tensor end_, top_, rise_, fall_, whole_ring_;
};

wood::Ring ring_of(const at::Tensor& numbers) {
  const float* n = numbers.data_ptr<float>();
  return {.end = n[0], .top = n[1], .rise = n[2], .fall = n[3], .mean = n[4]};
}

struct LatewoodRatio : torch::autograd::Function<LatewoodRatio> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& numbers, const at::Tensor& rings,
                            const at::Tensor& width) {
    const wood::Ring ring = ring_of(numbers);
    const at::Tensor ratio = at::empty_like(rings);
    over_blocks(rings.numel(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      wood::latewood_ratio(ring, rings.data_ptr<float>(), width.data_ptr<float>(), begin, end,
                           ratio.data_ptr<float>());
    });
    context->save_for_backward({numbers, rings, width});
    return ratio;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor &numbers = saved[0], &rings = saved[1], &width = saved[2];
    const wood::Ring ring = ring_of(numbers);
    const at::Tensor gradient = outputs.front().contiguous();
    const at::Tensor by_numbers = at::empty_like(numbers), by_rings = at::empty_like(rings),
                     by_width = at::empty_like(width);
    const std::vector<double> sums = sums_over_blocks(
        rings.numel(), wood::kRingNumbers, [&](std::int64_t begin, std::int64_t end, double* by_ring) {
          wood::latewood_ratio_backward(ring, rings.data_ptr<float>(), width.data_ptr<float>(), begin, end,
                                        gradient.data_ptr<float>(), by_rings.data_ptr<float>(),
                                        by_width.data_ptr<float>(), by_ring);
        });
    std::ranges::copy(sums, by_numbers.data_ptr<float>());
    return {by_numbers, by_rings, by_width};
  }
};

wood::RingField field_of(const at::Tensor& rings) {
  return {rings.data_ptr<float>(), rings.size(0), rings.size(1)};
}

struct RingWidths : torch::autograd::Function<RingWidths> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& rings) {
    constexpr std::int64_t kRowsWorthAThread = 32;
    const at::Tensor width = at::empty_like(rings);
    at::parallel_for(0, rings.size(0), kRowsWorthAThread, [&](std::int64_t begin, std::int64_t end) {
      wood::ring_widths(field_of(rings), begin, end, width.data_ptr<float>());
    });
    context->save_for_backward({rings, width});
    return width;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list saved = context->get_saved_variables();
    const at::Tensor by_rings = at::zeros_like(saved[0]);
    wood::ring_widths_backward(field_of(saved[0]), saved[1].data_ptr<float>(),
                               outputs.front().contiguous().data_ptr<float>(), by_rings.data_ptr<float>());
    return {by_rings};
  }
};

}  // namespace

at::Tensor latewood_ratio(const RingProfile& profile, const at::Tensor& rings, const at::Tensor& width) {
  if (rings.scalar_type() != at::kFloat) return latewood_ratio_by_tensors(profile, rings, width);
  return LatewoodRatio::apply(RingIntegral(profile).numbers(), rings.contiguous(), width.contiguous());
}

at::Tensor latewood_ratio_by_tensors(const RingProfile& profile, const at::Tensor& rings,
                                     const at::Tensor& width) {
  const RingIntegral integral(profile);
  // Whole rings between here and the pith drop out of the difference, and would cost digits.
  const at::Tensor begin = rings - width / 2;
  const at::Tensor from = begin - begin.detach().floor();
  const at::Tensor over_pixel = (integral(from + width) - integral(from)) / width;
  const at::Tensor contrast = at::hardtanh(at::rsub(2 * width, 2), 0, 1);
  // Rounding may leave a mean just outside of what is averaged.
  return at::hardtanh(at::lerp(integral.whole_ring(), over_pixel, contrast), 0, 1);
}

at::Tensor ring_widths(const at::Tensor& rings) {
  return rings.scalar_type() == at::kFloat ? RingWidths::apply(rings.contiguous())
                                           : ring_widths_by_tensors(rings);
}

at::Tensor ring_widths_by_tensors(const at::Tensor& rings) {
  const auto next = [&](int dim) {
    const std::int64_t n = rings.size(dim) - 1;
    const at::Tensor steps = (rings.narrow(dim, 1, n) - rings.narrow(dim, 0, n)).unsqueeze(0);
    return at::pad(steps, dim == 1 ? at::IntArrayRef({0, 1, 0, 0}) : at::IntArrayRef({0, 0, 0, 1}),
                   "replicate")
        .squeeze(0);
  };
  constexpr double kLeastSquare = 1e-6;  // a thousandth of a ring: keeps the division well-conditioned
  return (next(0).square() + next(1).square() + kLeastSquare).sqrt();
}

}  // namespace patina
