#pragma once

#include "engine/sampling/chain_state.h"
#include "engine/sampling/metric.h"
#include "engine/sampling/rng.h"

namespace patina {

/// Where a chain starts: continuous coordinates from N(mode, 2 C), discrete levels uniform, so that chains
/// start further apart than the posterior is wide and R-hat can tell whether they found each other (Gelman &
/// Rubin 1992). Starts that lie further below the mode than an over-dispersed normal would are drawn anew,
/// from a spread that narrows; the later half of the tries keep the mode's levels.
/// @param mode      position and evaluation of the posterior's mode
/// @param laplace   C, the covariance of the Laplace approximation there
/// @return a state of finite log density; the mode itself if no try of kStartTries will do
ChainState overdispersed_start(const LogDensity& target, const ChainState& mode, const Metric& laplace,
                               Rng& rng);

constexpr int kStartTries = 20;

}  // namespace patina
