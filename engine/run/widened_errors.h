#pragma once

#include <vector>

#include "engine/run/mode_search.h"
#include "engine/run/run_shared.h"
#include "engine/sampling/optimizer.h"

namespace patina {

/// Climbs on under other errors from the best of what a search ended in, a little way, on all processors.
/// @param target  the posterior under these, controlled, say   @param ends  best first, at least one
/// @return        best first
std::vector<OptimizerResult> climb_on(const LogDensity& target, const std::vector<Position>& ends);

/// Climbs likewise from the least deep mirror_images() of the best of these: other basins that a symmetry of
/// the material has made.
/// @param best      with its log density   @param laplace  the covariance about it, about
/// @param coordinates  of the target, along which to look
/// @return             those that have not climbed back
std::vector<OptimizerResult> climbed_images(const LogDensity& target, const ChainState& best,
                                            const Metric& laplace,
                                            const std::vector<Eigen::Index>& coordinates);

/// What a search found by hand-set errors, found again by errors that are wider by what irregularities do at
/// its best match: errors_of_irregularities(), and climbs on from its basins and their images under them. On
/// all processors.
/// @param by_hand  the posterior that was searched   @param found  where it ended, best first, at least one
/// @return         with the wider errors
/// @throws RunStopped
ModeFound widened(const Posterior& by_hand, const std::vector<Position>& found, IrregularityPool& pool,
                  std::uint64_t seed, RunShared& shared);

}  // namespace patina
