#pragma once

#include <ATen/core/Tensor.h>

#include "engine/summary/network.h"
#include "engine/summary/summary.h"

namespace patina {

/// The Gram matrix of a feature map, G_ij = mean over pixels of F_i F_j (paper equation 4), as a vector: its
/// upper triangle row by row, off-diagonal entries times sqrt 2, so that the vector's norm is G's Frobenius
/// norm.
/// @param features [k, c, h, w]   @return [k, c (c + 1) / 2]
at::Tensor gram_vector(const at::Tensor& features);

/// The same of the features' covariances, G_ij less the product of the means of F_i and F_j: what a texture
/// does about its mean, which tells materials apart far less than it weighs in a Gram matrix.
at::Tensor covariance_vector(const at::Tensor& features);

/// The Gram matrices of a network's feature maps (paper section 4, "Neural summary function"), their
/// covariances, or both, of one pass through the network: one relative block for each of its taps, the Gram
/// matrices' first.
class GramMatrices final : public Summary {
 public:
  enum class About { zero, mean, both };

  explicit GramMatrices(Network network, About about = About::zero)
      : network_(std::move(network)), about_(about) {}

  at::Tensor of(const at::Tensor& images) const override;
  std::vector<SummaryBlock> blocks() const override;
  int minimum_resolution() const override { return network_.minimum_resolution(); }

 private:
  Network network_;
  About about_;
};

}  // namespace patina
