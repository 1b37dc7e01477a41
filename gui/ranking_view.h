#pragma once

#include <string>

#include "engine/comparison/rank_materials.h"

namespace patina {

// What a ranking of materials tells someone who knows no evidences.

/// How likely a material is: "over 99 %", "42 %", "under 1 %", and whether it was not measured but only
/// looked at.
std::string likelihood_text(const RankedMaterial& material);

/// How well its best match fits the photo, with the figure beside: "fits (0.9)".
/// Empty where no match was searched for.
std::string fit_text(const RankedMaterial& material);

/// How far the figures can be trusted, and what to do about it.
std::string uncertainty_text(const MaterialRanking& ranking);

}  // namespace patina
