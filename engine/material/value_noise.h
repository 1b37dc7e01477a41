#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <vector>

namespace patina {

/// Periodic value noise (Perlin 1985's lattice, values in place of slopes): independent uniform values in
/// [0,1] at whole coordinates and linear interpolation between them; at all the widths at which it may be
/// seen: levels[j][i] has runs of 2^i values along x and 2^j along y averaged, and one more row and column
/// that repeat the first: [1, 1, rows / 2^j + 1, columns / 2^i + 1].
struct ValueNoise {
  std::vector<std::vector<at::Tensor>> levels;
};

constexpr double kLevelSharpness = -0.5;  ///< levels: linear interpolation blurs half a level by itself

/// @param rows, columns  the period, powers of two
ValueNoise make_value_noise(std::uint64_t seed, std::uint64_t stream, int rows, int columns);

/// The noise as pixels see it that are `width_x` by `width_y` coordinates wide: point samples of grain finer
/// than the pixels would say nothing true. Continuous and differentiable in all its arguments.
/// @param x, y              [h, w]
/// @param width_x, width_y  scalars, above 0
/// @return                  [h, w]. Of tensor operations, as all here: noise_kernel.h has the loops over
/// pixels
at::Tensor value_noise(const ValueNoise& noise, const at::Tensor& x, const at::Tensor& y,
                       const at::Tensor& width_x, const at::Tensor& width_y);

/// Value noise in space, of the same values in every direction and not filtered, as a grid with its
/// repetition: [1, channels, period + 1, period + 1, period + 1].
at::Tensor make_noise_volume(std::uint64_t seed, std::uint64_t stream, int channels, int period);

/// Where the points of a grid have got to, [h, w] each.
struct WarpedGrid {
  at::Tensor x, y;
};

/// A grid in space, whose points have moved along x and y by noise (domain warping): x + amplitude *
/// N_0(scale x, scale y, scale z), and y by the other channel.
/// @param volume            of two channels
/// @param x, y, z           [w], [h], [h]: of columns, and of rows
/// @param scale, amplitude  scalars
WarpedGrid warp_grid(const at::Tensor& volume, const at::Tensor& x, const at::Tensor& y, const at::Tensor& z,
                     const at::Tensor& scale, const at::Tensor& amplitude);

}  // namespace patina
