#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>

namespace patina {

/// Periodic fractal noise, a nearly scale-free sum of soft spots: each octave of cycles per map has the share
/// of variance, and the values the distribution, that models.md gives ("The maps").
/// @return [1, 1, size, size] in [0,1]
at::Tensor make_noise_map(std::uint64_t seed, std::uint64_t stream, int size);

}  // namespace patina
