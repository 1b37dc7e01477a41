#pragma once

#include <memory>

#include "engine/sampling/log_density.h"
#include "engine/sampling/metric.h"

namespace patina {

/// Where a chain is. The evaluation is kept so that the next transition starts without one.
struct ChainState {
  Position position;
  Evaluation evaluation;
};

enum class MoveKind { continuous, refresh, discrete };

/// What one transition did. Never fed back into the chain; adaptation and front ends read it.
struct TransitionInfo {
  MoveKind move = MoveKind::continuous;
  double accept_probability = 0;
  bool accepted = false;
  bool divergent = false;  ///< the proposal's log density was not finite, or fell by more than 1000 in a
                           ///< continuous move
  int evaluations = 0;
  double energy = 0;  ///< -log density of the state after the transition
};

/// All that adaptation may change; frozen after warm-up. The metric is shared, never mutated.
struct KernelSettings {
  double step_size = 0.5;
  std::shared_ptr<const Metric> metric;
};

}  // namespace patina
