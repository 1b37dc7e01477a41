#include "engine/material/noise_map.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/fft_ifft2.h>
#include <ATen/ops/polar.h>
#include <ATen/ops/real.h>
#include <ATen/ops/roll.h>

#include <algorithm>
#include <array>
#include <cmath>
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

/// Octaves above 1 cycle per map, as a fraction: 1.5 is in the middle of the second one.
double octaves_above_one(double row_frequency, double column_frequency) {
  return std::log2(std::max(std::hypot(row_frequency, column_frequency), 0.5));
}

/// Log density of variance per frequency, up to a constant: a power law between the octaves' middles.
double log_density(double octaves) {
  const double last = static_cast<double>(kOctaveShares.size()) - 2;
  const double place = std::clamp(std::floor(octaves - 0.5), 0.0, last);
  // An octave holds four times as many frequencies as the one below.
  const auto of_octave = [](double octave) {
    return std::log(kOctaveShares[static_cast<std::size_t>(octave)]) - octave * std::log(4.0);
  };
  return std::lerp(of_octave(place), of_octave(place + 1), octaves - 0.5 - place);
}

/// Amplitude of each frequency of fft2's layout: each octave its share, and no steps within or between them.
/// Steps would put too much of an octave at its upper end, and make the surface too steep.
at::Tensor octave_amplitudes(int size) {
  const auto frequency = [size](int k) { return k < size / 2 ? k : k - size; };
  std::array<double, kOctaveShares.size()> total{};
  at::Tensor amplitudes = at::empty({size, size}, at::kFloat);
  auto entry = amplitudes.accessor<float, 2>();
  const auto for_each = [&](auto&& visit) {
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const double octaves = octaves_above_one(frequency(row), frequency(column));
        const bool known = octaves >= 0 && octaves < static_cast<double>(kOctaveShares.size());
        if (known)
          visit(entry[row][column], octaves, static_cast<std::size_t>(octaves));
        else
          entry[row][column] = 0;
      }
  };
  for_each([&](float&, double octaves, std::size_t i) { total[i] += std::exp(log_density(octaves)); });
  for_each([&](float& amplitude, double octaves, std::size_t i) {
    amplitude = static_cast<float>(std::sqrt(std::exp(log_density(octaves)) * kOctaveShares[i] / total[i]));
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
