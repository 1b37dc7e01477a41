#pragma once

#include <memory>

#include "engine/sampling/log_density.h"
#include "engine/sampling/metric.h"
#include "engine/sampling/straightening.h"

namespace patina {

/// Where a chain is. The evaluation is kept so that the next transition starts without one. A move that needs
/// no gradient may leave none; complete() makes up for it when one is needed.
struct ChainState {
  Position position;
  Evaluation evaluation;
};

enum class MoveKind { continuous, refresh, discrete };

/// What one transition did. Never fed back into the chain; adaptation and front ends read it.
struct TransitionInfo {
  MoveKind move = MoveKind::continuous;
  double accept_probability = 0;  ///< of NUTS: averaged over its trajectory, as in Stan
  double second_stage = 1;        ///< probability that the target took what a cheaper density proposed
  bool accepted = false;          ///< of NUTS: the point drawn is not the one it started from
  bool divergent = false;  ///< met a log density that is not finite, or one that along the gradient fell,
                           ///< or an energy that spanned, more than 1000
  int evaluations = 0;
  int tree_depth = 1;  ///< how often NUTS doubled its trajectory; 1 for kernels without trees
  double energy =
      0;  ///< -log density of the state after the transition, plus its kinetic energy if it has one
};

/// All that adaptation may change; frozen after warm-up. What is pointed to is shared, never mutated.
struct KernelSettings {
  double step_size = 0.5;
  std::shared_ptr<const Metric> metric;  ///< of straightened coordinates, if a map says which
  std::shared_ptr<const Straightening> straightening = nullptr;  ///< null: coordinates are used as they are
};

}  // namespace patina
