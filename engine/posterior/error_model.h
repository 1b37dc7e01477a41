#pragma once

#include <ATen/core/Tensor.h>

#include <vector>

#include "engine/summary/summary.h"

namespace patina {

/// 1 / sigma for every entry of a summary: the Gaussian error model with a diagonal covariance (paper
/// equation 5, its Sigma_e set by hand as there).
///   relative blocks (Gram matrices): sigma = relative_sigma * |photo's block|, so that half the block's
///     chi-square is (relative Frobenius distance / relative_sigma)^2 / 2, however many entries it has;
///   absolute blocks (regional means): sigma = absolute_sigma, display units.
/// @param photo_summary  [sum of block sizes]
/// @return               same shape
at::Tensor inverse_sigmas(const at::Tensor& photo_summary, const std::vector<SummaryBlock>& blocks,
                          double relative_sigma, double absolute_sigma);

}  // namespace patina
