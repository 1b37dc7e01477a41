#pragma once

#include <vector>

#include "engine/material/parameter.h"
#include "engine/run/alarm.h"
#include "engine/run/draw.h"
#include "engine/run/summarize.h"

namespace patina {

/// What draws tell against themselves beside R-hat and ESS:
///   "alone"        one chain: nothing it could disagree with
///   "stuck"        a chain never moved
///   "modes"        separate kinds of match that chains hardly ever pass between
///   "divergences"  more than kMostDivergent of the transitions met what no path leads through
///   "energy"       a chain's E-BFMI is below kLeastEbfmi
///   "bound"        a parameter is piled up at a bound of its prior
/// @param draws  after warm-up, by chain
Alarms draw_alarms(const ParameterTable& table, const RunSummary& summary,
                   const std::vector<std::vector<const Draw*>>& draws);

constexpr double kMostDivergent = 0.01;  // of a chain's transitions
constexpr double kLeastEbfmi = 0.3;      // Betancourt 2016

}  // namespace patina
