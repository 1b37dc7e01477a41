#pragma once

#include <vector>

#include "engine/sampling/sample.h"

namespace patina {

/// What one chain counts, apart from the others'.
struct SampleTally {
  double accepted = 0;
  long continuous = 0, evaluations = 0;
  int divergences = 0;

  void add(const TransitionInfo& info);
};

/// Makes room for all draws.
void shape(Sample& sample, const LogDensity& target, const SampleSettings& settings);

/// Writes down draw t of chain k. Safe for several chains at a time.
void record(Sample& sample, Eigen::Index t, Eigen::Index k, const ChainState& state,
            const TransitionInfo& info);

/// Adds up what the chains counted, in their order.
void add_tallies(Sample& sample, const std::vector<SampleTally>& tallies);

}  // namespace patina
