#pragma once

#include <ATen/core/Tensor.h>

#include <vector>

#include "engine/summary/summary.h"

namespace patina {

/// The texture score of a pair of images: the mean over the relative blocks (Gram matrices) of
/// |a - b| / (|a| / 2 + |b| / 2), from 0 to 2.
/// @param a, b  their summaries   @param blocks  of that summary
double gram_distance(const at::Tensor& a, const at::Tensor& b, const std::vector<SummaryBlock>& blocks);

/// Spearman's correlation of two lists of one length: Pearson's of their ranks, ties at their mean rank.
/// @return NaN if all entries of a list are equal
double spearman(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace patina
