#include "engine/posterior/error_model.h"

#include <ATen/ops/cat.h>
#include <ATen/ops/full.h>
#include <ATen/ops/linalg_vector_norm.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patina {
namespace {

double sigma_of(const SummaryBlock& block, const at::Tensor& photo_block, double relative_sigma,
                double absolute_sigma) {
  // A constant photo has blocks of zeros; a floor keeps its posterior finite.
  constexpr double kSmallestNorm = 1e-6;
  constexpr double kEntriesOfMeans = 12;
  const auto entries = static_cast<double>(block.size);
  switch (block.scale) {
    case ErrorScale::relative:
      return relative_sigma * std::sqrt(block.views) *
             std::max(at::linalg_vector_norm(photo_block).item<double>(), kSmallestNorm);
    case ErrorScale::logarithmic:
      return relative_sigma * std::sqrt(entries);
    case ErrorScale::regional:
      return absolute_sigma * std::sqrt(entries / kEntriesOfMeans);
  }
  assert(false);
  return 1;
}

}  // namespace

at::Tensor inverse_sigmas(const at::Tensor& photo_summary, const std::vector<SummaryBlock>& blocks,
                          double relative_sigma, double absolute_sigma) {
  assert(relative_sigma > 0 && absolute_sigma > 0);
  std::vector<at::Tensor> parts;
  std::int64_t begin = 0;
  for (const SummaryBlock& block : blocks) {
    const at::Tensor photo_block = photo_summary.narrow(0, begin, block.size);
    const double sigma = sigma_of(block, photo_block, relative_sigma, absolute_sigma);
    parts.push_back(at::full({block.size}, 1 / sigma, photo_summary.options()));
    begin += block.size;
  }
  assert(begin == photo_summary.size(0));
  return at::cat(parts);
}

}  // namespace patina
