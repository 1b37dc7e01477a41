#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/sampling/kernel.h"
#include "engine/sampling/ladder.h"
#include "engine/sampling/serialise.h"

namespace patina {

/// One chain at the end of a ladder of its own from the prior, see tempering.h, between two transitions; on
/// the ladder {1} a chain of the target by itself. A transition is one of the kernel on each rung, then
/// swaps.
struct Climber {
  std::vector<double> betas{1};
  TemperedState state;
  SwapRecord swaps;                  ///< of this window, or since warm-up
  std::vector<ChainWarmup> warmups;  ///< of each rung that the kernel moves: all but the prior's

  const ChainState& on_target() const { return state.rungs.back(); }
  const KernelSettings& target_settings() const { return warmups.back().settings(); }

  /// All fields; see Archive.
  void serialise(Archive& archive) { archive(betas, state, swaps, warmups); }
};

/// @param rungs    1 for the target alone, else at least 2, prior and target included
/// @param metric   of the target, to begin with; rungs begin with what tempering makes of it
/// @param warms_up whether there will be a warm-up, for which a step size is to be found
/// @param start    where each rung begins: with a finite density
Climber begin_climb(const LogDensity& target, const Kernel& kernel, int rungs,
                    const std::shared_ptr<const Metric>& metric, bool warms_up,
                    const std::function<ChainState(Rng&)>& start, Rng& rng);

/// A transition that a climber can make: until it is taken it has not begun.
struct ClimberStep {
  TemperedState state;
  SwapRecord swaps;
  std::vector<TransitionInfo> rungs;  ///< of each that the kernel moved
  TransitionInfo on_target;           ///< the last of them, but with the evaluations of all rungs, and an
                                      ///< energy without kinetic part where the draw came by a swap
};

ClimberStep next_step(const LogDensity& target, const Kernel& kernel, const Climber& climber, Rng& rng);

/// Makes the transition; in warm-up every rung learns from it.
void take_step(ClimberStep step, bool warmup, Climber& climber);

/// To be called at the end of every window, see ChainWarmup::take_window().
LadderWindow take_window(Climber& climber);

/// Goes on with what the chains agreed on: all of it after a window that adapts metrics, else step sizes.
void go_on_with(const LadderSettings& agreed, bool adapts_metric, Climber& climber);

}  // namespace patina
