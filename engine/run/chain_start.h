#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/sampling/chain_state.h"
#include "engine/sampling/metric.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/rng.h"

namespace patina {

/// Where a chain starts: a draw from the prior (levels uniform; jagged coordinates, which nothing climbs,
/// from N(mode, 2 C)), from which it climbs only until it lies no deeper below the mode than a draw of twice
/// the posterior's variance would. What the photo pins down is then about right; along what it leaves open,
/// also along a bent ridge, chains start as far apart as the prior has it, so that R-hat can tell whether
/// they found each other (Gelman & Rubin 1992). A climb that does not get there is given up for a start
/// nearer to the mode; the later half of the tries keep the mode's levels.
/// @param mode      position and evaluation of the posterior's mode
/// @param laplace   C, the covariance of the Laplace approximation there
/// @return a state of finite log density; the mode itself if no try of kStartTries will do
ChainState overdispersed_start(const LogDensity& target, const ChainState& mode, const Metric& laplace,
                               Rng& rng);

/// The climb of overdispersed_start() from a place of the caller's; none where it does not get there.
std::optional<ChainState> climbed_start(const LogDensity& target, const ChainState& mode,
                                        const Position& from);

constexpr int kStartTries = 8;

/// The settings for RunSettings::start: "map", "predict", "prior", "prior-mean", "values".
std::vector<std::string> start_names();

/// The first place of finite density among kStartTries that `propose` names.
/// @throws UserError if there is none
ChainState start_at(const LogDensity& target, const std::function<Position(Rng&)>& propose, Rng& rng);

}  // namespace patina
