#include "engine/summary/gram.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/mm.h>
#include <ATen/ops/triu_indices.h>
#include <ATen/ops/where.h>

#include <numbers>

namespace patina {

at::Tensor gram_vector(const at::Tensor& features) {
  const std::int64_t channels = features.size(0);
  const at::Tensor flat = features.reshape({channels, -1});
  // With W the gradient with respect to F F^T, that with respect to F is (W + W^T) F: one product. Left to itself,
  // differentiation takes W F and W^T F apart and adds two arrays of the features' size.
  const at::Tensor half = at::mm(flat, flat.detach().t());
  const at::Tensor gram = (half + half.t() - half.detach()) / static_cast<double>(flat.size(1));
  const at::Tensor upper = at::triu_indices(channels, channels);
  const at::Tensor weights =
      at::where(upper[0] == upper[1], 1.0, std::numbers::sqrt2).to(features.scalar_type());
  return gram.reshape({-1}).index_select(0, upper[0] * channels + upper[1]) * weights;
}

at::Tensor GramMatrices::operator()(const at::Tensor& image) const {
  std::vector<at::Tensor> parts;
  for (const at::Tensor& features : network_.features(image)) parts.push_back(gram_vector(features));
  return at::cat(parts);
}

std::vector<SummaryBlock> GramMatrices::blocks() const {
  std::vector<SummaryBlock> blocks;
  for (const std::int64_t channels : network_.feature_channels())
    blocks.push_back(
        {"gram " + std::to_string(blocks.size() + 1), channels * (channels + 1) / 2, ErrorScale::relative});
  return blocks;
}

}  // namespace patina
