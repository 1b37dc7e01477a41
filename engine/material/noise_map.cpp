#include "engine/material/noise_map.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/fft_ifft2.h>
#include <ATen/ops/polar.h>
#include <ATen/ops/real.h>
#include <ATen/ops/roll.h>
#include <ATen/ops/zeros.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "engine/material/hash.h"
#include "engine/material/quantile_map.h"

namespace patina {
namespace {

/// Share of variance by octave of cycles per map, 1-2 to 256-512 (models.md). The last one, rounded to .01
/// there, decides how steep the finest grain is; .006 has the steepness of the reference renders of plaster.
constexpr std::array<double, 9> kOctaveShares{.17, .23, .13, .11, .11, .10, .09, .05, .006};

constexpr std::array<QuantileKnot, 7> kNoiseValues{
    {{0, 0.0f}, {0.05, 0.13f}, {0.25, 0.25f}, {0.5, 0.35f}, {0.75, 0.47f}, {0.95, 0.65f}, {1, 1.0f}}};

/// Variance of a frequency of that square, at least 1, up to a constant: a power law between the octaves'
/// middles.
double density(int square) {
  static const auto kLogs = [] {
    std::array<double, kOctaveShares.size()> logs;
    // An octave holds four times as many frequencies as the one below.
    for (std::size_t i = 0; i < logs.size(); ++i)
      logs[i] = std::log(kOctaveShares[i]) - static_cast<double>(i) * std::log(4.0);
    return logs;
  }();
  const double octaves = std::log2(square) / 2;  // above 1 cycle per map: 1.5 is in the second one's middle
  const double last = static_cast<double>(kOctaveShares.size()) - 2;
  const double place = std::clamp(std::floor(octaves - 0.5), 0.0, last);
  const auto i = static_cast<std::size_t>(place);
  return std::exp(std::lerp(kLogs[i], kLogs[i + 1], octaves - 0.5 - place));
}

/// Amplitude of each frequency of fft2's layout: each octave its share, and no steps within or between them.
/// Steps would put too much of an octave at its upper end, and make the surface too steep.
at::Tensor octave_amplitudes(int size) {
  const int half = size / 2;
  at::Tensor amplitudes = at::zeros({size, size}, at::kFloat);
  auto entry = amplitudes.accessor<float, 2>();
  const auto for_quadrant = [&](auto&& visit) {
    for (int row = 0; row <= half; ++row)
      for (int column = 0; column <= half; ++column) {
        const int square = row * row + column * column;
        const auto octave = static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(square)) - 1) / 2;
        if (square > 0 && octave < kOctaveShares.size()) visit(row, column, square, octave);
      }
  };
  const auto opposite = [&](int frequency) { return (size - frequency) % size; };
  std::array<double, kOctaveShares.size()> total{};
  for_quadrant([&](int row, int column, int square, std::size_t octave) {
    const double variance = density(square);
    const int images = (row == opposite(row) ? 1 : 2) * (column == opposite(column) ? 1 : 2);
    total[octave] += images * variance;
    entry[row][column] = static_cast<float>(variance);
  });
  for_quadrant([&](int row, int column, int, std::size_t octave) {
    const double variance = double{entry[row][column]} * kOctaveShares[octave] / total[octave];
    const auto amplitude = static_cast<float>(std::sqrt(variance));
    for (const int i : {row, opposite(row)})
      for (const int j : {column, opposite(column)}) entry[i][j] = amplitude;
  });
  return amplitudes;
}

}  // namespace

at::Tensor make_noise_map(std::uint64_t seed, std::uint64_t stream, int size) {
  at::Tensor phases = at::empty({size, size}, at::kFloat);
  float* phase = phases.data_ptr<float>();
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(phases.numel()); ++i)
    phase[i] = static_cast<float>(2 * std::numbers::pi * uniform_hash(seed, stream, i));
  // Opposite at opposite frequencies, for a real map: its real part alone would leave to chance how much of
  // each wave is left, and with it the shares of the lowest octaves.
  const at::Tensor opposite = phases - at::roll(phases.flip({0, 1}), {1, 1}, {0, 1});
  at::Tensor map = at::real(at::fft_ifft2(at::polar(octave_amplitudes(size), opposite))).contiguous();
  map_to_quantiles({map.data_ptr<float>(), static_cast<std::size_t>(map.numel())}, kNoiseValues);
  return map.view({1, 1, size, size});
}

}  // namespace patina
