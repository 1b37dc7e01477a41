#pragma once

#include <cstdint>
#include <vector>

#include "engine/run/chain.h"
#include "engine/run/run_shared.h"
#include "engine/run/warmup_meeting.h"

namespace patina {

/// What all chains of a run came to, by the time that they had ended.
struct ChainsDone {
  std::int64_t draws = 0;                ///< after warm-up, all chains
  std::vector<double> warmup, sampling;  ///< seconds of each chain
};

/// Runs all chains of a plan, one thread each, until they have made their draws or are stopped; a failure is
/// left in `shared`. A chain whose file finds no room on the disk waits for it.
/// @param record  of meetings that were held before the run was taken up again
/// @throws UserError for a chain's files that are damaged or belong to another run   @throws RunStopped
ChainsDone run_chains(const ChainPlan& plan, const WarmupRecord& record, RunShared& shared);

}  // namespace patina
