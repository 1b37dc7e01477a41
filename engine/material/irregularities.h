#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <memory>

#include "engine/material/look_up.h"
#include "engine/material/value_noise.h"

namespace patina {

/// exp(i phase(f)) of independent uniform phases, one per integer frequency f, as seen from the centre of the
/// first pixel: [n, n/2 + 1, 2], real and imaginary parts, laid out as fft2 of a real image: rows 0 ... -1,
/// columns 0 ... n/2.
struct Phasors {
  at::Tensor forward;   ///< at f
  at::Tensor mirrored;  ///< the conjugate of that at -f
};

/// The irregularities of wood (models.md, "The maps").
struct WoodNoise {
  ValueNoise ring_widths;  ///< G1, along x
  ValueNoise streaks;      ///< G2
  at::Tensor distortion;   ///< G3: a volume of two channels, x and y (value_noise.h)
};

/// The random input z of every material, all of it a pure function of one seed: where the bumps, cells and
/// flakes lie. Made on first use and kept, also for use under gradients; safe to use from several threads.
class Irregularities {
 public:
  static constexpr int kMapSize =
      1024;  ///< texels a side of a generated map, the finest level, its border left out
  static constexpr int kMapChoices = 3;  ///< how many different noise and cell maps there are to choose from

  explicit Irregularities(std::uint64_t seed);
  ~Irregularities();

  std::uint64_t seed() const;

  /// A frequency's phase does not depend on n, so that a finer grid only adds detail.
  /// @param type  float32, or float64
  Phasors phasors(int n, at::ScalarType type = at::kFloat) const;

  /// Fractal noise in [0,1], one channel, float32; choice in [0, kMapChoices).
  MipMap noise(int choice) const;

  /// Voronoi cells: 0 on the edges, 1 inside, one channel, float32; choice in [0, kMapChoices).
  MipMap cells(int choice) const;

  /// cells(cell_choice) and noise(noise_choice) as the two channels of one map.
  MipMap cells_and_noise(int cell_choice, int noise_choice) const;

  /// Flakes: their slopes along x and y and those' variance, three channels, float32 (flake_map.h).
  MipMap flakes() const;

  WoodNoise wood() const;

  /// noise(0), stretched over an image: [n + 1, n + 1] with neighbours (look_up.h), float32.
  at::Tensor grain(int n) const;

 private:
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace patina
