#pragma once

#include "engine/sampling/chain_state.h"
#include "engine/sampling/log_density.h"
#include "engine/sampling/rng.h"

namespace patina {

/// The Metropolis-Hastings decision (Hastings 1970): replaces `state` by `proposal` with probability
/// min(1, exp(log_ratio)), else leaves it as it is. A proposal whose log density is not finite, or a ratio
/// that is NaN, is never accepted. Takes one uniform from rng in every case.
/// @param log_ratio  log of pi(proposal) q(proposal -> state) / (pi(state) q(state -> proposal))
/// @param divergent_below  a log density that falls by more than this is flagged divergent
TransitionInfo metropolis_step(MoveKind move, double log_ratio, double divergent_below, ChainState proposal,
                               ChainState& state, Rng& rng);

/// The same for a proposal of which value_finite() may have left the gradient empty: it is evaluated once the
/// proposal is accepted, and a gradient that is not finite then rejects it after all. Never flagged
/// divergent: a proposal drawn from afar is just a bad one.
TransitionInfo metropolis_step_by_value(MoveKind move, double log_ratio, const LogDensity& target,
                                        ChainState proposal, ChainState& state, Rng& rng);

}  // namespace patina
