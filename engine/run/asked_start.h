#pragma once

#include <functional>

#include "engine/image.h"
#include "engine/posterior/posterior.h"
#include "engine/run/run_settings.h"
#include "engine/sampling/rng.h"

namespace patina {

/// The settings' start values over the priors' means. @throws UserError
ParameterValues start_values(const ParameterTable& table, const RunSettings& settings);

/// Where the settings ask chains to start; empty: about the best match (overdispersed_start()).
/// @param posterior  outlives the result
std::function<Position(Rng&)> start_of(const Posterior& posterior, const RunSettings& settings,
                                       const Image& photo);

}  // namespace patina
