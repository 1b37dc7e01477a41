#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <memory>

#include "engine/summary/packed_convolution.h"
#include "engine/summary/precision.h"

namespace patina {

/// A convolution of a feature map with its frozen weights, prepared for both directions. Maps are rounded to
/// the weights' precision on their way in.
struct FrozenConvolution {
  at::Tensor weight;    ///< [out, in, k, k], k odd
  at::Tensor bias;      ///< [out]
  at::Tensor mirrored;  ///< [in, out, k, k]: the convolution that takes gradients back
  bool relu = true;
  bool reflect = true;  ///< padding by reflection, not with zeros; either keeps the size
  std::shared_ptr<const PackedConvolution> packed;  ///< ReLU included; none where there is none

  FrozenConvolution(const at::Tensor& weight, const at::Tensor& bias, bool relu, bool reflect,
                    Precision precision = Precision::float32);

  std::int64_t border() const { return weight.size(2) / 2; }  ///< pixels of padding on each side
};

// The steps of a network on a feature map [k, channels, h, w] float32, channels last, of k images;
// differentiable once, by the map alone. On the processor each is one pass over memory where tensor
// operations (library_steps.h, for other devices) would take several.

/// [ReLU] (weight * x + bias).
at::Tensor convolve(const FrozenConvolution& convolution, const at::Tensor& x);

/// Means of 2 x 2 blocks, stride 2; an odd last row or column is dropped. Of a map in planes, as images are,
/// it makes planes.
at::Tensor average_pool(const at::Tensor& x);

}  // namespace patina
