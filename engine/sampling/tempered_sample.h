#pragma once

#include <cstdint>
#include <vector>

#include "engine/sampling/sample.h"

namespace patina {

/// A sample of a target, and how well its ladder served it.
struct TemperedSample {
  Sample sample;                          ///< of the target's rung; evaluations are of all rungs
  std::vector<double> betas;              ///< the ladder that warm-up ended with
  std::vector<double> swap_rejection;     ///< mean of each pair of neighbouring rungs, after warm-up
  std::vector<std::int64_t> round_trips;  ///< of each chain, after warm-up: see TemperedState

  /// What swaps are rejected all along the ladder: the smaller, the fewer rungs are needed (about twice as
  /// many are best).
  double barrier() const;
};

/// sample() with every chain at the end of a ladder of its own from the prior, see tempering.h: a transition
/// is one of the kernel on each rung, then swaps. Warm-up adapts step size and metric of every rung, over all
/// chains, and the ladder, for equally many rejected swaps. For targets of several modes, which chains by
/// themselves do not leave; it costs as many evaluations as there are rungs.
/// @param rungs  at least 2, prior and target included
/// @throws std::invalid_argument for fewer, or where no draw of the prior has a density
TemperedSample sample_tempered(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
                               int rungs);

}  // namespace patina
