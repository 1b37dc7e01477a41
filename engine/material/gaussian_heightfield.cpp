#include "engine/material/gaussian_heightfield.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/fft_irfft2.h>
#include <ATen/ops/roll.h>
#include <ATen/ops/view_as_complex.h>
#include <ATen/ops/where.h>

namespace patina {
namespace {

/// A's factor along one axis at each frequency, and at its negative: [n] in fft's layout.
struct Profile {
  at::Tensor forward, mirrored;
};

Profile profile(const at::Tensor& sigma, double size_cm, int n) {
  const at::Tensor k = at::arange(n, sigma.options().requires_grad(false));
  const at::Tensor frequency = (at::where(k < (n + 1) / 2, k, k - n) + 0.5) / size_cm;
  // A spectrum narrower than this is a plane wave already; without the bound, 0 would divide by 0.
  const at::Tensor forward = (frequency.square() * (-0.5 / sigma.clamp_min(1e-3).square())).exp();
  return {forward, at::roll(forward.flip(0), 1)};
}

}  // namespace

at::Tensor gaussian_heightfield(const Irregularities& z, const at::Tensor& fscale, const at::Tensor& sigma_x,
                                const at::Tensor& sigma_y, double size_cm, int resolution) {
  // Re ifft(S) = irfft(H), H(f) = (S(f) + conj S(-f)) / 2, and A has one factor an axis.
  const std::int64_t n = resolution, half = n / 2 + 1;
  const Phasors phasors = z.phasors(resolution, fscale.scalar_type());
  const Profile x = profile(sigma_x, size_cm, resolution);
  const Profile y = sigma_y.is_same(sigma_x) ? x : profile(sigma_y, size_cm, resolution);
  const at::Tensor strength = fscale * (0.5 / (size_cm * size_cm));
  const auto outer = [&](const at::Tensor& along_y, const at::Tensor& along_x) {
    return (along_y * strength).view({n, 1, 1}) * along_x.narrow(0, 0, half).view({1, half, 1});
  };
  const at::Tensor spectrum =
      outer(y.forward, x.forward) * phasors.forward + outer(y.mirrored, x.mirrored) * phasors.mirrored;
  return at::fft_irfft2(at::view_as_complex(spectrum), at::IntArrayRef({n, n}), {-2, -1}, "forward");
}

}  // namespace patina
