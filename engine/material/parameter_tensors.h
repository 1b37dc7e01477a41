#pragma once

#include <ATen/core/Tensor.h>
#include <ATen/ops/stack.h>

#include <utility>
#include <vector>

namespace patina {

/// @param scalar  float32
inline double number_of(const at::Tensor& scalar) { return static_cast<double>(*scalar.data_ptr<float>()); }

/// The continuous parameters of a material in the table's order, each a scalar tensor of its own: gradients
/// flow to those that ask for one, and for the others no graph is built.
class ParameterTensors {
 public:
  ParameterTensors(std::vector<at::Tensor> scalars) : scalars_(std::move(scalars)) {}
  /// @param vector  [parameters]; gradients flow through it
  ParameterTensors(const at::Tensor& vector) : scalars_(vector.unbind()) {}

  const at::Tensor& operator[](std::size_t i) const { return scalars_[i]; }
  /// Several in a row, [count].
  at::Tensor run(std::size_t first, std::size_t count) const {
    return at::stack(at::TensorList(scalars_).slice(first, count));
  }
  at::ScalarType scalar_type() const { return scalars_.front().scalar_type(); }
  /// For constants beside them.
  at::TensorOptions options() const { return scalars_.front().options().requires_grad(false); }

 private:
  std::vector<at::Tensor> scalars_;
};

}  // namespace patina
