#pragma once

#include <ATen/core/Tensor.h>

#include <vector>

#include "engine/summary/summary.h"

namespace patina {

/// 1 / sigma for every entry of a summary: the Gaussian error model with a diagonal covariance (paper
/// equation 5, its Sigma_e set by hand as there).
///   relative blocks (Gram matrices): sigma = relative_sigma * |photo's block|, so that half the block's
///     chi-square is (relative Frobenius distance / relative_sigma)^2 / 2, however many entries it has; times
///     the root of its views, so that what two blocks see alike counts once;
///   logarithmic blocks (spectra): sigma = relative_sigma * sqrt(entries). Power is a second moment, as a
///   Gram
///     matrix is, and a small error of its logarithm is its relative error: half the chi-square is (root mean
///     square error of the logarithms / relative_sigma)^2 / 2, that of one Gram matrix. At 0.2 and 8 rings
///     sigma is 0.57; with z alone, the coarsest ring, of 4 independent waves, scatters by about 0.5;
///   regional blocks (mean colours): sigma = absolute_sigma * sqrt(entries / 12), display units. What a model
///     gets wrong about a highlight is smooth: neighbouring regions share it, and regions half the size are
///     not twice the evidence. absolute_sigma is that of the 4 regions and 3 colours of "means".
/// @param photo_summary  [sum of block sizes]
/// @return               same shape
at::Tensor inverse_sigmas(const at::Tensor& photo_summary, const std::vector<SummaryBlock>& blocks,
                          double relative_sigma, double absolute_sigma);

}  // namespace patina
