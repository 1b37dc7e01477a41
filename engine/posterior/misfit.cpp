#include "engine/posterior/misfit.h"

#include <ATen/core/Tensor.h>
#include <ATen/ops/linalg_vector_norm.h>

#include <cmath>

#include "engine/summary/summary.h"

namespace patina {

std::vector<BlockMisfit> block_misfits(const at::Tensor& residual, const std::vector<SummaryBlock>& blocks,
                                       double relative_sigma, double absolute_sigma) {
  constexpr double kUnitsOfMeans = 12;  // see inverse_sigmas(): all entries of other blocks are one unit
  std::vector<BlockMisfit> misfits;
  std::int64_t begin = 0;
  for (const SummaryBlock& block : blocks) {
    const double norm = at::linalg_vector_norm(residual.narrow(0, begin, block.size)).item<double>();
    const bool is_colour = block.scale == ErrorScale::regional;
    const double in_errors = is_colour ? norm / std::sqrt(kUnitsOfMeans) : norm;
    const double sigma = is_colour ? absolute_sigma : relative_sigma * std::sqrt(block.views);
    misfits.push_back({block.name, is_colour, in_errors * sigma, in_errors});
    begin += block.size;
  }
  return misfits;
}

}  // namespace patina
