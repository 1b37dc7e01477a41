#pragma once

#include "engine/comparison/rank_materials.h"
#include "engine/image.h"

namespace patina {

/// Whether the network that tells materials apart can be used, and has learned all of these.
bool can_glance(const std::vector<std::string>& materials);

/// Ranks materials by that network alone (prediction/material_chooser.h), in a second or two: log evidence is
/// the logarithm of the probability, the match a predictor's guess, and what would take a search is left out.
/// @param settings  materials that can_glance() affirms
MaterialRanking glance(const Image& photo, const RankSettings& settings);

}  // namespace patina
