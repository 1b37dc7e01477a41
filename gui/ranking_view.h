#pragma once

#include <string>

#include "engine/run/rank_materials.h"

namespace patina {

// What a ranking of materials tells someone who knows no evidences.

/// What a material has of the first one's claim, for a bar, 0 to 1, and in words: by a glance how likely it
/// is, "over 99 % at first sight", "42 %", "under 1 %"; after a search how much further off its other samples
/// are than the first one's, "nearest", "21 % further off".
struct Standing {
  double share;
  std::string words;
};
Standing standing(const RankedMaterial& material, const RankedMaterial& first);

/// How well its best match fits the photo, with the figure beside: "fits (0.9)".
/// Empty where no match was searched for.
std::string fit_text(const RankedMaterial& material);

/// How far the figures can be trusted, and what to do about it.
std::string uncertainty_text(const MaterialRanking& ranking);

}  // namespace patina
