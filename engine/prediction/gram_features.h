#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/summary/summary.h"

namespace patina {

/// How many features append_gram makes of a block of second moments.
Eigen::Index gram_features_of(const SummaryBlock& block);

/// Of a block of second moments of a network's channels, an upper triangle row by row with off-diagonal
/// entries times sqrt 2: logarithms of the diagonal and, of up to 32 channels, correlations row by row.
void append_gram(const SummaryBlock& block, const float* triangle, std::vector<float>& features);

}  // namespace patina
