#include "engine/material/irregularities.h"

#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/ones_like.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/polar.h>
#include <ATen/ops/roll.h>
#include <ATen/ops/view_as_real.h>
#include <c10/core/InferenceMode.h>

#include <array>
#include <cassert>
#include <map>
#include <mutex>
#include <numbers>

#include "engine/material/cell_map.h"
#include "engine/material/hash.h"
#include "engine/material/noise_map.h"

namespace patina {
namespace {

enum Stream : std::uint64_t { kPhases = 1, kNoise = 100, kCells = 200 };

// Larger grids are for export, once.
constexpr int kLargestKept = 1024;

/// Random phases at the map's corner, carried on to the centre of the first pixel: grids of all sizes then
/// sample one surface.
at::Tensor make_phases(std::uint64_t seed, int n) {
  at::Tensor phases = at::empty({n, n}, at::kDouble);
  auto entry = phases.accessor<double, 2>();
  const auto frequency = [n](int k) { return k < (n + 1) / 2 ? k : k - n; };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const auto f = static_cast<std::uint32_t>(frequency(row)),
                 g = static_cast<std::uint32_t>(frequency(column));
      const double at_corner = 2 * uniform_hash(seed, kPhases, (std::uint64_t{f} << 32) | g);
      const double to_centre = static_cast<double>(frequency(row) + frequency(column)) / n;
      entry[row][column] = std::numbers::pi * (at_corner + to_centre);
    }
  return phases;
}

Phasors make_phasors(std::uint64_t seed, int n, at::ScalarType type) {
  const at::Tensor phases = make_phases(seed, n);
  const at::Tensor all = at::polar(at::ones_like(phases), phases);
  const at::Tensor opposite = at::roll(all.flip({0, 1}), {1, 1}, {0, 1}).conj().resolve_conj();
  const auto half = [&](const at::Tensor& grid) {
    return at::view_as_real(grid.narrow(1, 0, n / 2 + 1)).to(type).contiguous();
  };
  return {.forward = half(all), .mirrored = half(opposite)};
}

at::Tensor with_border(const at::Tensor& map) { return at::pad(map, {1, 1, 1, 1}, "circular"); }

}  // namespace

struct Irregularities::Cache {
  std::uint64_t seed;
  std::mutex mutex;
  std::map<int, Phasors> phasors;
  std::array<at::Tensor, kMapChoices> noise, cells;
  std::array<at::Tensor, kMapChoices * kMapChoices> cells_and_noise;

  /// The value kept at `place`, made now if there is none. A tensor born in inference mode could never serve
  /// a gradient.
  template <typename Make>
  at::Tensor keep(at::Tensor& place, Make&& make) {
    const std::lock_guard lock(mutex);
    const c10::InferenceMode normal_mode(false);
    if (!place.defined()) place = make();
    return place;
  }
};

Irregularities::Irregularities(std::uint64_t seed) : cache_(std::make_unique<Cache>()) {
  cache_->seed = seed;
}
Irregularities::~Irregularities() = default;

std::uint64_t Irregularities::seed() const { return cache_->seed; }

Phasors Irregularities::phasors(int n, at::ScalarType type) const {
  const c10::InferenceMode normal_mode(false);
  if (n > kLargestKept || type != at::kFloat) return make_phasors(cache_->seed, n, type);
  const std::lock_guard lock(cache_->mutex);
  const auto found = cache_->phasors.find(n);
  if (found != cache_->phasors.end()) return found->second;
  return cache_->phasors.emplace(n, make_phasors(cache_->seed, n, type)).first->second;
}

at::Tensor Irregularities::noise(int choice) const {
  assert(choice >= 0 && choice < kMapChoices);
  const auto i = static_cast<std::size_t>(choice);
  return cache_->keep(cache_->noise[i],
                      [&] { return with_border(make_noise_map(cache_->seed, kNoise + i, kMapSize)); });
}

at::Tensor Irregularities::cells(int choice) const {
  assert(choice >= 0 && choice < kMapChoices);
  const auto i = static_cast<std::size_t>(choice);
  return cache_->keep(cache_->cells[i],
                      [&] { return with_border(make_cell_map(cache_->seed, kCells + i, kMapSize)); });
}

at::Tensor Irregularities::cells_and_noise(int cell_choice, int noise_choice) const {
  const at::Tensor cell_map = cells(cell_choice), noise_map = noise(noise_choice);
  const auto i = static_cast<std::size_t>(cell_choice * kMapChoices + noise_choice);
  return cache_->keep(cache_->cells_and_noise[i], [&] { return at::cat({cell_map, noise_map}, 1); });
}

}  // namespace patina
