#pragma once

#include <vector>

#include "engine/sampling/tempering.h"
#include "engine/sampling/warmup.h"

namespace patina {

/// What chains on equal ladders go on with.
struct LadderSettings {
  std::vector<double> betas;          ///< inverse temperatures; {1}: the target alone
  std::vector<KernelSettings> rungs;  ///< of those that a kernel moves: all but the prior's
};

/// What one chain brings to the end of a window.
struct LadderWindow {
  std::vector<double> betas;  ///< that the window was run with
  std::vector<WindowResult> rungs;
  SwapRecord swaps;
};

/// What all chains make of a window: pool() of every rung, and the ladder on which swaps would have been
/// rejected equally often.
/// @param chains  not empty, of equal ladders
LadderSettings pool(const std::vector<LadderWindow>& chains, MetricKind kind, double metric_worth = 0,
                    const std::vector<bool>& jagged = {});

}  // namespace patina
