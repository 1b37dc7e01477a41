#pragma once

#include "engine/sampling/chain_state.h"

namespace patina {

/// The log Metropolis-Hastings ratio of preconditioned MALA (Roberts & Tweedie 1996), whose proposal is
///   y = x + step^2/2 C grad(x) + step L xi,  xi ~ N(0, I),  C = L L^T:
///   log pi(y) - log pi(x) + log q(y -> x) - log q(x -> y)
/// with the proposal's quadratic forms multiplied out, so that C^-1 is not needed:
///   log q(y -> x) - log q(x -> y) = -1/2 (y - x).(gx + gy) - step^2/8 (gy.C gy - gx.C gx).
double mala_log_ratio(const KernelSettings& settings, const ChainState& from, const ChainState& to);

}  // namespace patina
