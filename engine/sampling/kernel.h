#pragma once

#include "engine/sampling/chain_state.h"
#include "engine/sampling/rng.h"

namespace patina {

/// One Markov transition that leaves the target invariant. Stateless: all that changes is the state and the
/// generator that are passed in. A rejected proposal leaves the state as it is (the caller records it again).
class Kernel {
 public:
  virtual ~Kernel() = default;

  virtual TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                              Rng& rng) const = 0;

  /// The mean acceptance probability that step-size adaptation aims at; 0 where there is no step size.
  virtual double target_acceptance() const = 0;
};

}  // namespace patina
