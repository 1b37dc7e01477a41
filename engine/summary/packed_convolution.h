#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <memory>

namespace patina {

/// A convolution, and ReLU on demand, in one pass of the library's, for which its weights are laid out once:
/// libtorch's prepacked operators, which no header of it declares. Not differentiable.
class PackedConvolution {
 public:
  /// @param weight   [out, in, k, k]   @param bias  [out]
  /// @param padding  zeros on each side
  /// @return none where the library has no such operators, or none for these weights (of a graphics card, or
  ///         not float32)
  static std::shared_ptr<const PackedConvolution> make(const at::Tensor& weight, const at::Tensor& bias,
                                                       bool relu, std::int64_t padding);
  virtual ~PackedConvolution() = default;

  /// Of maps of any size, [n, in, h, w] float32, on any thread.
  virtual at::Tensor of(const at::Tensor& x) const = 0;
};

}  // namespace patina
