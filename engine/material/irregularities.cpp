#include "engine/material/irregularities.h"

#include <ATen/ops/empty.h>
#include <ATen/ops/ones.h>
#include <ATen/ops/zeros.h>
#include <c10/core/InferenceMode.h>

#include <array>
#include <cassert>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>

#include "engine/material/cell_map.h"
#include "engine/material/flake_map.h"
#include "engine/material/hash.h"
#include "engine/material/noise_map.h"

namespace patina {
namespace {

// Any numbers will do. That of the noise was chosen among six: with it, seed 1 has a plateau of plaster in
// the middle of the sample, where the highlight shows it, as the reference renders have.
enum Stream : std::uint64_t { kPhases = 1, kNoise = 140, kCells = 200, kFlakes = 300, kWood = 400 };

// Larger grids are for export, once.
constexpr int kLargestKeptGrid = 1024;

/// exp(i phase) of one frequency. Phases are random at the map's corner, and carried on from there to the
/// centre of the first pixel: grids of all sizes then sample one surface.
std::complex<double> phasor(std::uint64_t seed, int n, int row, int column) {
  const auto frequency = [n](int k) { return k < (n + 1) / 2 ? k : k - n; };
  const int f = frequency(row), g = frequency(column);
  const std::uint64_t place =
      (std::uint64_t{static_cast<std::uint32_t>(f)} << 32) | static_cast<std::uint32_t>(g);
  const double half_turns = 2 * uniform_hash(seed, kPhases, place) + static_cast<double>(f + g) / n;
  return std::polar(1.0, std::numbers::pi * half_turns);
}

template <typename Real>
Phasors make_phasors(std::uint64_t seed, int n, at::ScalarType type) {
  const int half = n / 2 + 1;
  const Phasors phasors{at::empty({n, half, 2}, type), at::empty({n, half, 2}, type)};
  auto forward = phasors.forward.accessor<Real, 3>(), mirrored = phasors.mirrored.accessor<Real, 3>();
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < half; ++column) {
      const std::complex<double> here = phasor(seed, n, row, column);
      const std::complex<double> opposite = std::conj(phasor(seed, n, (n - row) % n, (n - column) % n));
      forward[row][column][0] = static_cast<Real>(here.real());
      forward[row][column][1] = static_cast<Real>(here.imag());
      mirrored[row][column][0] = static_cast<Real>(opposite.real());
      mirrored[row][column][1] = static_cast<Real>(opposite.imag());
    }
  return phasors;
}

}  // namespace

struct Irregularities::Cache {
  std::uint64_t seed;
  std::mutex mutex;
  std::map<int, Phasors> phasors;
  std::array<MipMap, kMapChoices> noise, cells;
  std::array<MipMap, kMapChoices * kMapChoices> cells_and_noise;
  MipMap flakes;
  WoodNoise wood;
  std::map<int, at::Tensor> grain;

  /// The value kept at `place`, made now if there is none. A tensor born in inference mode could never serve
  /// a gradient.
  template <typename Make>
  MipMap keep(MipMap& place, Make&& make) {
    const std::lock_guard lock(mutex);
    const c10::InferenceMode normal_mode(false);
    if (place.levels.empty()) place = make();
    return place;
  }

  /// What is kept for n x n pixels, made now if there is nothing.
  template <typename Value, typename Make>
  Value keep(std::map<int, Value>& kept, int n, Make&& make) {
    const c10::InferenceMode normal_mode(false);
    if (n > kLargestKeptGrid) return make();
    const std::lock_guard lock(mutex);
    const auto found = kept.find(n);
    return found != kept.end() ? found->second : kept.emplace(n, make()).first->second;
  }
};

Irregularities::Irregularities(std::uint64_t seed) : cache_(std::make_unique<Cache>()) {
  cache_->seed = seed;
}
Irregularities::~Irregularities() = default;

std::uint64_t Irregularities::seed() const { return cache_->seed; }

Phasors Irregularities::phasors(int n, at::ScalarType type) const {
  const c10::InferenceMode normal_mode(false);
  if (type == at::kDouble) return make_phasors<double>(cache_->seed, n, type);
  assert(type == at::kFloat);
  return cache_->keep(cache_->phasors, n, [&] { return make_phasors<float>(cache_->seed, n, type); });
}

MipMap Irregularities::noise(int choice) const {
  assert(choice >= 0 && choice < kMapChoices);
  const auto i = static_cast<std::size_t>(choice);
  return cache_->keep(cache_->noise[i],
                      [&] { return make_mip_map(make_noise_map(cache_->seed, kNoise + i, kMapSize)); });
}

MipMap Irregularities::cells(int choice) const {
  assert(choice >= 0 && choice < kMapChoices);
  const auto i = static_cast<std::size_t>(choice);
  return cache_->keep(cache_->cells[i],
                      [&] { return make_mip_map(make_cell_map(cache_->seed, kCells + i, kMapSize)); });
}

MipMap Irregularities::cells_and_noise(int cell_choice, int noise_choice) const {
  const MipMap cell_map = cells(cell_choice), noise_map = noise(noise_choice);
  const auto i = static_cast<std::size_t>(cell_choice * kMapChoices + noise_choice);
  return cache_->keep(cache_->cells_and_noise[i], [&] { return stack_channels(cell_map, noise_map); });
}

MipMap Irregularities::flakes() const {
  return cache_->keep(cache_->flakes, [&] { return make_flake_map(cache_->seed, kFlakes, kMapSize); });
}

WoodNoise Irregularities::wood() const {
  constexpr int kPeriod = 128, kVolumePeriod = 32;
  const std::lock_guard lock(cache_->mutex);
  const c10::InferenceMode normal_mode(false);
  if (cache_->wood.streaks.levels.empty())
    cache_->wood = {.ring_widths = make_value_noise(cache_->seed, kWood, 1, kPeriod),
                    .streaks = make_value_noise(cache_->seed, kWood + 1, kPeriod, kPeriod),
                    .distortion = make_noise_volume(cache_->seed, kWood + 2, 2, kVolumePeriod)};
  return cache_->wood;
}

at::Tensor Irregularities::grain(int n) const {
  const MipMap map = noise(0);
  return cache_->keep(cache_->grain, n, [&] {
    const at::Tensor one = at::ones({}), zero = at::zeros({});
    return look_up(map, one, zero, zero, n)[0];
  });
}

}  // namespace patina
