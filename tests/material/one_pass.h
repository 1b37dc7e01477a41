#pragma once

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <gtest/gtest.h>

#include <vector>

namespace patina {

/// A field and its gradient by every input, given a gradient by the field that differs from pixel to pixel.
struct Outcome {
  at::Tensor value;
  std::vector<at::Tensor> gradients;
};

template <class F>
Outcome outcome_of(const F& field_of, const std::vector<at::Tensor>& inputs, at::ScalarType type) {
  std::vector<at::Tensor> leaves;
  for (const at::Tensor& input : inputs)
    leaves.push_back(input.to(at::kFloat).to(type).detach().set_requires_grad(true));
  const at::Tensor value = field_of(leaves);
  value.backward(at::arange(value.numel(), value.options()).view(value.sizes()).sin());
  Outcome result{value.detach(), {}};
  for (const at::Tensor& leaf : leaves) result.gradients.push_back(leaf.grad());
  return result;
}

/// Of values and gradients, relative to the largest.
inline double difference(const at::Tensor& a, const at::Tensor& b) {
  const double size = 1e-6 + b.abs().max().item<double>();
  return (a.to(at::kDouble) - b).abs().max().item<double>() / size;
}

/// What is computed in one pass over pixels in float32, and its gradient in another, agrees with tensor
/// operations in double precision.
/// @param tolerance  of gradients, which are sums of what differs in sign
template <class F, class G>
void expect_same(const F& in_one_pass, const G& by_tensors, const std::vector<at::Tensor>& inputs,
                 double tolerance = 2e-4) {
  const Outcome fused = outcome_of(in_one_pass, inputs, at::kFloat),
                reference = outcome_of(by_tensors, inputs, at::kDouble);
  EXPECT_LT(difference(fused.value, reference.value), 2e-5);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!reference.gradients[i].defined() || reference.gradients[i].abs().max().item<double>() == 0) continue;
    ASSERT_TRUE(fused.gradients[i].defined()) << "input " << i;
    EXPECT_LT(difference(fused.gradients[i], reference.gradients[i]), tolerance) << "input " << i;
  }
}

/// Neither a multiple of the pixels that are taken at once nor within one period; no pixel on the lattice.
inline at::Tensor places(double step, double begin) {
  return at::arange(37 * 41, at::kDouble).view({37, 41}) * step + begin;
}

}  // namespace patina
