#include "engine/material/growth_rings.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/clamp.h>
#include <ATen/ops/hardtanh.h>
#include <ATen/ops/lerp.h>
#include <ATen/ops/minimum.h>
#include <ATen/ops/ones_like.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/rsub.h>
#include <ATen/ops/zeros_like.h>

namespace patina {
namespace {

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

 private:
  at::Tensor within_ring(const at::Tensor& t) const {
    const at::Tensor rising = at::minimum(t, rise_);
    const at::Tensor falling = at::clamp((t - (end_ - fall_)), at::zeros_like(fall_), fall_);
    const at::Tensor after = (t - end_).clamp_min(0);
    return top_ * (rising.square() / (2 * rise_) - rising + t - falling.square() / (2 * fall_) - after);
  }

  at::Tensor end_, top_, rise_, fall_, whole_ring_;
};

}  // namespace

at::Tensor latewood_ratio(const RingProfile& profile, const at::Tensor& rings, const at::Tensor& width) {
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
