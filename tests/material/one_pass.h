#pragma once

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <gtest/gtest.h>

#include <cmath>
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

/// The sum of the magnitudes whose sum with their signs is a gradient by the scalar inputs[i], and a little
/// more, so that it is above 0.
template <class F>
double summed_magnitudes(const F& field_of, std::vector<at::Tensor> inputs, std::size_t i) {
  const at::Tensor here = inputs[i];
  const double step = 1e-6 * (1 + std::abs(here.item<double>()));
  inputs[i] = here + step;
  const at::Tensor ahead = field_of(inputs);
  inputs[i] = here - step;
  const at::Tensor slope = ((ahead - field_of(inputs)) / (2 * step)).flatten();
  return (slope * at::arange(slope.numel(), slope.options()).sin()).abs().sum().item<double>() + 5e-7;
}

/// As expect_same(), where all inputs are scalars: gradients may be sums of much that cancels out, which is
/// what their errors are measured by.
template <class F, class G>
void expect_same_by_scalars(const F& in_one_pass, const G& by_tensors, const std::vector<at::Tensor>& inputs,
                            double of_values = 1e-4) {
  const Outcome fused = outcome_of(in_one_pass, inputs, at::kFloat),
                reference = outcome_of(by_tensors, inputs, at::kDouble);
  EXPECT_LT(difference(fused.value, reference.value), of_values);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!reference.gradients[i].defined()) continue;
    const double error = fused.gradients[i].item<double>() - reference.gradients[i].item<double>();
    EXPECT_LT(std::abs(error), 2e-4 * summed_magnitudes(by_tensors, inputs, i)) << "input " << i;
  }
}

/// Neither a multiple of the pixels that are taken at once nor within one period; no pixel on the lattice.
inline at::Tensor places(double step, double begin) {
  return at::arange(37 * 41, at::kDouble).view({37, 41}) * step + begin;
}

}  // namespace patina
