#pragma once

#include "engine/posterior/posterior.h"
#include "engine/run/run_settings.h"

namespace patina {

/// The posterior that a run's settings mean, at another resolution: a coarser level of the search, say.
PosteriorSettings posterior_settings(const RunSettings& settings, int resolution);

/// The same on a level of a search's pyramid: all but the last, the run's own, leave out what misleads far
/// from a match.
PosteriorSettings search_settings(const RunSettings& settings, int level);

}  // namespace patina
