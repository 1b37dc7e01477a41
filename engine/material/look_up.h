#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <vector>

namespace patina {

/// A periodic map at all the scales at which it may be looked at (Williams 1983, "Pyramidal parametrics"):
/// level l is level 0 averaged over blocks of 2^l x 2^l texels.
///
/// A level spans [-1,1] x [-1,1], repeats, and carries one texel of that repetition on every side, so that a
/// bilinear look-up can cross the seam: [1, channels, size / 2^l + 2, size / 2^l + 2].
struct MipMap {
  std::vector<at::Tensor> levels;

  const at::Tensor& finest() const { return levels.front(); }
};

/// Texels a side of a level without its border.
std::int64_t period_of(const at::Tensor& level);

/// @param map  [1, channels, size, size], size a power of two, at least 16: one period, without border
MipMap make_mip_map(const at::Tensor& map);

/// Two maps of one size as the channels of one, so that one look-up serves both.
MipMap stack_channels(const MipMap& first, const MipMap& second);

/// What a look-up adds to an image's pixels: the row above it and the column to its right, which normals
/// need.
enum class Neighbours { none, above_and_right };

/// Looks a periodic map up at ((pixel coordinate in [-1,1]) + shift) * scale, so that scale < 1 magnifies
/// (models.md "Capture"); trilinearly, at the level whose texels, interpolated, are as wide as the pixels.
/// Point samples of a map that is finer than the image would make the image, and every posterior over it, a
/// rough function of scale and shift. Continuous and differentiable in both.
/// @param scale, shift_x, shift_y  scalars, scale > 0
/// @return    [c, n + 1, n + 1], the image with its neighbours, or [c, n, n] without.
///            In float32 one pass over the pixels, and one for the gradient, which has no further
///            derivatives; else as look_up_by_tensors(), the reference
at::Tensor look_up(const MipMap& map, const at::Tensor& scale, const at::Tensor& shift_x,
                   const at::Tensor& shift_y, int resolution,
                   Neighbours neighbours = Neighbours::above_and_right);
at::Tensor look_up_by_tensors(const MipMap& map, const at::Tensor& scale, const at::Tensor& shift_x,
                              const at::Tensor& shift_y, int resolution,
                              Neighbours neighbours = Neighbours::above_and_right);

/// The image itself of planes with neighbours. @param planes [..., n + 1, n + 1]   @return [..., n, n]
at::Tensor without_neighbours(const at::Tensor& planes);

}  // namespace patina
