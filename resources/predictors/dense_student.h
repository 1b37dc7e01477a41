#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <vector>

#include "engine/summary/safetensors.h"

namespace patina {

/// A DenseNetwork (engine/prediction/dense_network.h) while it learns.
class DenseStudent {
 public:
  /// @param features  [n, inputs], that say what standard is   @param hidden  units of each of two layers
  DenseStudent(const at::Tensor& features, std::int64_t hidden, std::int64_t outputs, std::uint64_t seed);

  std::vector<at::Tensor> parameters() const;

  /// Features standardised, and cut as a DenseNetwork does. @return [n, inputs]
  at::Tensor standardised(const at::Tensor& features) const;

  /// @param inputs  standardised   @return [n, outputs]
  at::Tensor operator()(const at::Tensor& inputs) const;

  /// The tensors that DenseNetwork::read() takes.
  SafeTensors to_file() const;

 private:
  at::Tensor mean_, sd_;
  std::vector<at::Tensor> weights_, biases_;
};

}  // namespace patina
