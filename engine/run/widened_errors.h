#pragma once

#include "engine/posterior/wider_errors.h"
#include "engine/run/mode_search.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_shared.h"

namespace patina {

/// errors_of_irregularities() at a run's best match, on all processors, with messages in its status.
/// @throws RunStopped
WiderErrors widen_errors(const Posterior& posterior, const Position& match, const RunSettings& settings,
                         RunShared& shared);

/// Climbs on from the basins of a search under a posterior whose errors have become wider: mode, basins and
/// covariance are under it. @throws RunStopped
void find_again(const Posterior& posterior, ModeFound& found, RunShared& shared);

}  // namespace patina
