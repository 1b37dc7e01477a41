#include "engine/posterior/error_model.h"

#include <ATen/ops/cat.h>
#include <ATen/ops/full.h>
#include <ATen/ops/linalg_vector_norm.h>

#include <algorithm>
#include <cassert>

namespace patina {

at::Tensor inverse_sigmas(const at::Tensor& photo_summary, const std::vector<SummaryBlock>& blocks,
                          double relative_sigma, double absolute_sigma) {
  assert(relative_sigma > 0 && absolute_sigma > 0);
  // A constant photo has blocks of zeros; a floor keeps its posterior finite.
  constexpr double kSmallestNorm = 1e-6;
  std::vector<at::Tensor> parts;
  std::int64_t begin = 0;
  for (const SummaryBlock& block : blocks) {
    double sigma = absolute_sigma;
    if (block.relative) {
      const at::Tensor part = photo_summary.narrow(0, begin, block.size);
      sigma = relative_sigma * std::max(at::linalg_vector_norm(part).item<double>(), kSmallestNorm);
    }
    parts.push_back(at::full({block.size}, 1 / sigma, photo_summary.options()));
    begin += block.size;
  }
  assert(begin == photo_summary.size(0));
  return at::cat(parts);
}

}  // namespace patina
