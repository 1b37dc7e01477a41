#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "engine/sampling/chain_state.h"
#include "engine/sampling/log_density.h"
#include "engine/sampling/rng.h"

namespace patina {

/// For moves that follow no path which they could lose: far falls are what proposals from afar make.
constexpr double kNeverDivergent = std::numeric_limits<double>::infinity();

/// The Metropolis-Hastings decision (Hastings 1970): replaces `state` by `proposal` with probability
/// min(1, exp(log_ratio)), else leaves it as it is. A proposal whose log density is not finite, or a ratio
/// that is NaN, is never accepted. Takes one uniform from rng in every case.
/// @param log_ratio  log of pi(proposal) q(proposal -> state) / (pi(state) q(state -> proposal))
/// @param divergent_below  a log density that falls by more than this is flagged divergent
TransitionInfo metropolis_step(MoveKind move, double log_ratio, double divergent_below, ChainState proposal,
                               ChainState& state, Rng& rng);

/// Evaluates the gradient that an earlier move left out.
/// @return the evaluations that it took, 0 or 1; nothing where the gradient is not finite. A gradient kernel
/// must not lead away from such a state, for it never leads there.
std::optional<int> complete(const LogDensity& target, ChainState& state);

/// A gradient kernel's transition from a state that is complete(); step() makes it, and what completing took
/// is added to its evaluations. Where the gradient is not finite the state is held, flagged divergent.
TransitionInfo with_gradient(const LogDensity& target, ChainState& state,
                             const std::function<TransitionInfo()>& step);

}  // namespace patina
