#pragma once

#include <vector>

#include "engine/comparison/rank_materials.h"
#include "engine/image.h"

namespace patina {

/// Whether the network that tells materials apart can be used, and has learned all of these.
bool can_glance(const std::vector<std::string>& materials);

/// Log probabilities of these materials, all equally likely beforehand, or none if it cannot be used.
std::vector<double> glances(const Image& photo, const std::vector<std::string>& materials);

/// Ranks materials by that network alone (prediction/material_chooser.h), in a second or two: log evidence is
/// the logarithm of the probability, the match a predictor's guess, and what would take a search is left out.
/// @throws UserError if it cannot be used, or has not learned all of them
MaterialRanking glance(const Image& photo, const RankSettings& settings);

}  // namespace patina
