#pragma once

#include "engine/sampling/chain_state.h"
#include "engine/sampling/log_density.h"

namespace patina {

/// How deep the target falls on the straight way between two places, in nats below the lower of them; 0 where
/// it does not. Little for two places on one ridge, though it may bend.
/// @param from, to  with their log densities and the same levels; a few values are taken in between
double valley_between(const LogDensity& target, const ChainState& from, const ChainState& to);

}  // namespace patina
