#include "engine/material/noise_map.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/fft_ifft2.h>
#include <ATen/ops/polar.h>
#include <ATen/ops/real.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/material/hash.h"
#include "engine/material/quantile_map.h"

namespace patina {
namespace {

/// Share of variance by octave of cycles per map, 1-2 to 256-512 (models.md).
constexpr std::array<double, 9> kOctaveShares{.17, .23, .13, .11, .11, .10, .09, .05, .01};

constexpr std::array<QuantileKnot, 7> kNoiseValues{
    {{0, 0.0f}, {0.05, 0.13f}, {0.25, 0.25f}, {0.5, 0.35f}, {0.75, 0.47f}, {0.95, 0.65f}, {1, 1.0f}}};

int octave_of(double row_frequency, double column_frequency) {
  const double radius = std::hypot(row_frequency, column_frequency);
  return radius < 1 ? -1 : static_cast<int>(std::log2(radius));
}

/// Amplitude of each frequency of fft2's layout, equal within an octave.
at::Tensor octave_amplitudes(int size) {
  const auto frequency = [size](int k) { return k < size / 2 ? k : k - size; };
  std::array<double, kOctaveShares.size()> count{};
  at::Tensor amplitudes = at::empty({size, size}, at::kFloat);
  auto entry = amplitudes.accessor<float, 2>();
  const auto for_each = [&](auto&& visit) {
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column)
        visit(row, column, octave_of(frequency(row), frequency(column)));
  };
  const auto known = [](int octave) {
    return octave >= 0 && octave < static_cast<int>(kOctaveShares.size());
  };
  for_each([&](int, int, int octave) {
    if (known(octave)) count[static_cast<std::size_t>(octave)] += 1;
  });
  for_each([&](int row, int column, int octave) {
    const auto i = static_cast<std::size_t>(octave);
    entry[row][column] = known(octave) ? static_cast<float>(std::sqrt(kOctaveShares[i] / count[i])) : 0;
  });
  return amplitudes;
}

}  // namespace

at::Tensor make_noise_map(std::uint64_t seed, std::uint64_t stream, int size) {
  at::Tensor phases = at::empty({size, size}, at::kFloat);
  float* phase = phases.data_ptr<float>();
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(phases.numel()); ++i)
    phase[i] = static_cast<float>(2 * std::numbers::pi * uniform_hash(seed, stream, i));
  at::Tensor map = at::real(at::fft_ifft2(at::polar(octave_amplitudes(size), phases))).contiguous();
  map_to_quantiles({map.data_ptr<float>(), static_cast<std::size_t>(map.numel())}, kNoiseValues);
  return map.view({1, 1, size, size});
}

}  // namespace patina
