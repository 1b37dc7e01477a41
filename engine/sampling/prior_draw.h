#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/sampling/chain_state.h"
#include "engine/sampling/rng.h"

namespace patina {

// For targets in coordinates in which the prior is N(0, I) and all levels are equally likely.

/// A draw of discrete coordinates that have so many levels each.
Eigen::VectorXi draw_levels(const std::vector<int>& levels, Rng& rng);

/// A draw of the prior.
Position prior_draw(const LogDensity& target, Rng& rng);

/// A draw of the prior as a state of the target. Makes one evaluation, of the value alone, which may find no
/// density there.
ChainState prior_state(const LogDensity& target, Rng& rng);

}  // namespace patina
