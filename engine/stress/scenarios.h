#pragma once

#include <string>
#include <vector>

#include "engine/stress/scenario.h"

namespace patina {

// Densities whose answer is known, one list a way to fail.
std::vector<Scenario> bound_scenarios();
std::vector<Scenario> ridge_scenarios();
std::vector<Scenario> mode_scenarios();
std::vector<Scenario> edge_scenarios();       ///< kinks, floors, cliffs, places without a number
std::vector<Scenario> precision_scenarios();  ///< noise and rounding of the value
std::vector<Scenario> start_scenarios();      ///< starts, step sizes, and counts of chains and draws

/// Renders of a material, in good and in poor photos, through a run with its directory.
std::vector<Scenario> photo_scenarios(const std::string& material);

}  // namespace patina
