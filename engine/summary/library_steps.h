#pragma once

#include "engine/summary/feature_steps.h"

namespace patina {

// The steps of a network out of the library's own operations: what other devices than the processor have
// kernels of, and the reference for convolve() and average_pool(). Equal on every call, gradients included.

/// convolve(), of a map and weights on any device.
at::Tensor convolve_by_library(const FrozenConvolution& convolution, const at::Tensor& x);

/// average_pool(), of a map on any device.
at::Tensor average_pool_by_library(const at::Tensor& x);

}  // namespace patina
