#include "engine/summary/log_spectrum.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/fft_rfft.h>
#include <ATen/ops/fft_rfft2.h>
#include <ATen/ops/mm.h>
#include <ATen/ops/view_as_real.h>
#include <ATen/ops/zeros.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patina {
namespace {

/// Rec. 709 luma of the display values. @param images [k, 3, n, n]   @return [k, n, n]
at::Tensor luma(const at::Tensor& images) {
  return 0.2126 * images.select(1, 0) + 0.7152 * images.select(1, 1) + 0.0722 * images.select(1, 2);
}

at::Tensor power(const at::Tensor& transform) { return at::view_as_real(transform).square().sum(-1); }

at::Tensor log_bands(const at::Tensor& power, const at::Tensor& weights) {
  return (at::mm(power.reshape({power.size(0), -1}), weights) + kRoundingPower).log();
}

/// The band of a frequency of at least 1; the last takes all above.
int band_of(double frequency, const std::vector<int>& edges) {
  const auto above = std::upper_bound(edges.begin(), edges.end() - 1, frequency);
  return static_cast<int>(above - edges.begin()) - 1;
}

at::Tensor normalised(const at::Tensor& weights) { return weights / weights.sum(0, /*keepdim=*/true); }

at::Tensor frequency_ring_weights(std::int64_t n, int rings) {
  const std::vector<int> edges = band_edges(static_cast<int>(n / 2), rings);
  const std::int64_t half = n / 2 + 1;
  at::Tensor weights = at::zeros({n * half, rings}, at::kFloat);
  auto entry = weights.accessor<float, 2>();
  for (std::int64_t row = 0; row < n; ++row)
    for (std::int64_t column = 0; column < half; ++column) {
      if (row == 0 && column == 0) continue;
      const double fy = static_cast<double>(std::min(row, n - row)), fx = static_cast<double>(column);
      // The transform of a real image holds half the plane: most of it stands for its mirror image, too.
      const bool on_the_axis = column == 0 || 2 * column == n;
      entry[row * half + column][band_of(std::hypot(fx, fy), edges)] = on_the_axis ? 1 : 2;
    }
  return normalised(weights);
}

at::Tensor band_weights(std::int64_t n, int bands) {
  const std::vector<int> edges = band_edges(static_cast<int>(n / 2), bands);
  at::Tensor weights = at::zeros({n / 2 + 1, bands}, at::kFloat);
  auto entry = weights.accessor<float, 2>();
  for (std::int64_t f = 1; f <= n / 2; ++f)
    entry[f][band_of(static_cast<double>(f), edges)] = 2 * f == n ? 1 : 2;
  return normalised(weights);
}

}  // namespace

std::vector<int> band_edges(int nyquist, int bands) {
  assert(bands > 0 && nyquist >= bands);
  std::vector<int> edges{1};
  for (int band = 1; band < bands; ++band) {
    const double equal_ratios = std::pow(nyquist, static_cast<double>(band) / bands);
    edges.push_back(std::max(edges.back() + 1, static_cast<int>(std::lround(equal_ratios))));
  }
  edges.push_back(nyquist + 1);
  return edges;
}

RingSpectrum::RingSpectrum(int rings)
    : rings_(rings), weights_([rings](std::int64_t n) { return frequency_ring_weights(n, rings); }) {}

at::Tensor RingSpectrum::of(const at::Tensor& images) const {
  const at::Tensor transform = at::fft_rfft2(luma(images), {}, {-2, -1}, "ortho");
  return log_bands(power(transform), weights_.of_side(images.size(3)));
}

std::vector<SummaryBlock> RingSpectrum::blocks() const {
  return {{"Fourier rings", rings_, ErrorScale::logarithmic}};
}

ColumnSpectrum::ColumnSpectrum(int bands)
    : bands_(bands), weights_([bands](std::int64_t n) { return band_weights(n, bands); }) {}

at::Tensor ColumnSpectrum::of(const at::Tensor& images) const {
  const at::Tensor transform = at::fft_rfft(luma(images), {}, /*dim=*/1, "ortho");
  return log_bands(power(transform).mean(2), weights_.of_side(images.size(3)));
}

std::vector<SummaryBlock> ColumnSpectrum::blocks() const {
  return {{"Fourier bands", bands_, ErrorScale::logarithmic}};
}

}  // namespace patina
