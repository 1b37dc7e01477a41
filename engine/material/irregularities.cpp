#include "engine/material/irregularities.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>

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

at::Tensor make_phases(std::uint64_t seed, int n) {
  at::Tensor phases = at::empty({n, n}, at::kFloat);
  auto entry = phases.accessor<float, 2>();
  const auto frequency = [n](int k) { return static_cast<std::uint32_t>(k < n / 2 ? k : k - n); };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const std::uint64_t place = (std::uint64_t{frequency(row)} << 32) | frequency(column);
      entry[row][column] = static_cast<float>(2 * std::numbers::pi * uniform_hash(seed, kPhases, place));
    }
  return phases;
}

}  // namespace

struct Irregularities::Cache {
  std::uint64_t seed;
  std::mutex mutex;
  std::map<int, at::Tensor> phases;
  std::array<at::Tensor, kMapChoices> noise, cells;
  std::map<std::pair<int, int>, at::Tensor> cells_and_noise;
};

Irregularities::Irregularities(std::uint64_t seed) : cache_(std::make_unique<Cache>()) {
  cache_->seed = seed;
}
Irregularities::~Irregularities() = default;

std::uint64_t Irregularities::seed() const { return cache_->seed; }

at::Tensor Irregularities::phases(int n) const {
  const std::lock_guard lock(cache_->mutex);
  at::Tensor& kept = cache_->phases[n];
  if (!kept.defined()) kept = make_phases(cache_->seed, n);
  return kept;
}

at::Tensor Irregularities::noise(int choice) const {
  assert(choice >= 0 && choice < kMapChoices);
  const std::lock_guard lock(cache_->mutex);
  at::Tensor& kept = cache_->noise[static_cast<std::size_t>(choice)];
  if (!kept.defined())
    kept = make_noise_map(cache_->seed, kNoise + static_cast<std::uint64_t>(choice), kMapSize);
  return kept;
}

at::Tensor Irregularities::cells(int choice) const {
  assert(choice >= 0 && choice < kMapChoices);
  const std::lock_guard lock(cache_->mutex);
  at::Tensor& kept = cache_->cells[static_cast<std::size_t>(choice)];
  if (!kept.defined())
    kept = make_cell_map(cache_->seed, kCells + static_cast<std::uint64_t>(choice), kMapSize);
  return kept;
}

at::Tensor Irregularities::cells_and_noise(int cell_choice, int noise_choice) const {
  const at::Tensor cell_map = cells(cell_choice), noise_map = noise(noise_choice);
  const std::lock_guard lock(cache_->mutex);
  at::Tensor& kept = cache_->cells_and_noise[{cell_choice, noise_choice}];
  if (!kept.defined()) {
    const at::NoGradGuard no_grad;
    kept = at::cat({cell_map, noise_map}, 1);
  }
  return kept;
}

}  // namespace patina
