#pragma once

#include <ATen/core/Tensor.h>

#include "engine/summary/network.h"
#include "engine/summary/summary.h"

namespace patina {

/// The Gram matrix of a feature map, G_ij = mean over pixels of F_i F_j (paper equation 4), as a vector: its
/// upper triangle row by row, off-diagonal entries times sqrt 2, so that the vector's norm is G's Frobenius
/// norm.
/// @param features [c, h, w]   @return [c (c + 1) / 2]
at::Tensor gram_vector(const at::Tensor& features);

/// The Gram matrices of a network's feature maps (paper section 4, "Neural summary function"), one relative
/// block for each tap of the network.
class GramMatrices final : public Summary {
 public:
  explicit GramMatrices(Network network) : network_(std::move(network)) {}

  at::Tensor operator()(const at::Tensor& image) const override;
  std::vector<SummaryBlock> blocks() const override;
  int minimum_resolution() const override { return network_.minimum_resolution(); }

 private:
  Network network_;
};

}  // namespace patina
