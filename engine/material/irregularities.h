#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <memory>

namespace patina {

/// The random input z of every material, all of it a pure function of one seed: where the bumps, cells and
/// flakes lie. Maps are made on first use and kept; safe to use from several threads.
class Irregularities {
 public:
  static constexpr int kMapSize = 1024;  ///< pixels a side of a generated map, which spans [-1,1] x [-1,1]
  static constexpr int kMapChoices = 3;  ///< how many different noise and cell maps there are to choose from

  explicit Irregularities(std::uint64_t seed);
  ~Irregularities();

  std::uint64_t seed() const;

  /// Independent uniform phases in [0, 2 pi), [n, n], one per integer frequency, laid out as fft2 expects.
  /// A frequency's phase does not depend on n, so that a finer grid only adds detail.
  at::Tensor phases(int n) const;

  /// Fractal noise in [0,1], [1, 1, kMapSize, kMapSize], periodic; choice in [0, kMapChoices).
  at::Tensor noise(int choice) const;

  /// Voronoi cells: 0 on the edges, 1 inside, [1, 1, kMapSize, kMapSize], periodic.
  at::Tensor cells(int choice) const;

  /// cells(cell_choice) and noise(noise_choice) as the two channels of one map, [1, 2, kMapSize, kMapSize].
  at::Tensor cells_and_noise(int cell_choice, int noise_choice) const;

 private:
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace patina
