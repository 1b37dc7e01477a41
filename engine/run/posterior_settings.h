#pragma once

#include "engine/posterior/posterior.h"
#include "engine/run/run_settings.h"

namespace patina {

/// The posterior that a run's settings mean, at another resolution: a coarser level of the search, say.
PosteriorSettings posterior_settings(const RunSettings& settings, int resolution);

}  // namespace patina
