#include "engine/material/gaussian_heightfield.h"

#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/fft_irfft2.h>
#include <ATen/ops/repeat_interleave.h>
#include <ATen/ops/roll.h>
#include <ATen/ops/view_as_complex.h>
#include <ATen/ops/where.h>
#include <ATen/ops/zeros.h>
#include <torch/csrc/autograd/custom_function.h>

#include "engine/material/pixel_blocks.h"
#include "engine/material/spectrum_kernel.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

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

/// amplitudes_by_tensors() in float32, one pass over the frequencies each way. First derivatives only.
struct Amplitudes : torch::autograd::Function<Amplitudes> {
  /// @param inputs  along y, its mirror image, along x, its mirror image, phasors, theirs
  static at::Tensor forward(AutogradContext* context, at::TensorList inputs) {
    const at::Tensor amplitudes = at::empty_like(inputs[4]);
    const std::int64_t rows = amplitudes.size(0);
    at::parallel_for(0, rows, kRowsAtOnce, [&](std::int64_t begin, std::int64_t end) {
      spectrum::amplitudes(laid_out(inputs), begin, end, amplitudes.data_ptr<float>());
    });
    context->save_for_backward(inputs.vec());
    return amplitudes;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const variable_list inputs = context->get_saved_variables();
    const at::Tensor given = outputs.front().contiguous();
    variable_list by(inputs.size());  // nothing for the phasors
    by[0] = at::empty_like(inputs[0]);
    by[1] = at::empty_like(inputs[1]);
    // A block's sums stand for themselves until all are done: the total does not depend on the threads.
    const at::Tensor by_x = at::zeros({blocks_of(given.size(0), kRowsAtOnce), inputs[2].numel()},
                                      given.options()),
                     by_mirrored_x = at::zeros_like(by_x);
    over_blocks(given.size(0), kRowsAtOnce, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      spectrum::amplitudes_backward(laid_out(inputs), begin, end, given.data_ptr<float>(),
                                    {by[0].data_ptr<float>(), by[1].data_ptr<float>(),
                                     by_x[block].data_ptr<float>(), by_mirrored_x[block].data_ptr<float>()});
    });
    by[2] = by_x.sum(0);
    by[3] = by_mirrored_x.sum(0);
    return by;
  }

 private:
  static constexpr std::int64_t kRowsAtOnce = 32;

  static spectrum::Problem laid_out(at::TensorList inputs) {
    const auto data = [&](std::size_t i) { return inputs[i].data_ptr<float>(); };
    return {data(0), data(1), data(2), data(3), data(4), data(5), inputs[2].numel()};
  }
};

/// Factors along y (strength included) and along x, [n] and [n / 2 + 1] each. @return  [n, n / 2 + 1, 2]
at::Tensor amplitudes(const Profile& y, const Profile& x, const Phasors& phasors) {
  const auto both_parts = [](const at::Tensor& factor) { return at::repeat_interleave(factor, 2); };
  return Amplitudes::apply(
      at::TensorList({y.forward.contiguous(), y.mirrored.contiguous(), both_parts(x.forward),
                      both_parts(x.mirrored), phasors.forward, phasors.mirrored}));
}

at::Tensor amplitudes_by_tensors(const Profile& y, const Profile& x, const Phasors& phasors) {
  const auto outer = [](const at::Tensor& along_y, const at::Tensor& along_x) {
    return along_y.view({-1, 1, 1}) * along_x.view({1, -1, 1});
  };
  return outer(y.forward, x.forward) * phasors.forward + outer(y.mirrored, x.mirrored) * phasors.mirrored;
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
  const Profile along_y{y.forward * strength, y.mirrored * strength};
  const Profile along_x{x.forward.narrow(0, 0, half), x.mirrored.narrow(0, 0, half)};
  const at::Tensor spectrum = fscale.scalar_type() == at::kFloat
                                  ? amplitudes(along_y, along_x, phasors)
                                  : amplitudes_by_tensors(along_y, along_x, phasors);
  return at::fft_irfft2(at::view_as_complex(spectrum), at::IntArrayRef({n, n}), {-2, -1}, "forward");
}

}  // namespace patina
