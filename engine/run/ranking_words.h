#pragma once

#include <string>

#include "engine/run/rank_materials.h"

namespace patina {

/// "leather, whose other samples come 21 % nearer to the photo than those of plaster, the next": what a
/// ranking found, in one or two sentences for people who know no evidences.
std::string in_words(const MaterialRanking& ranking);

/// Whether what the order goes by could be the other way round within its error: twice the standard errors of
/// the distances where there are such, else of the log evidences or what Laplace's approximation is taken to
/// be off by.
bool within_error(const RankedMaterial& a, const RankedMaterial& b);

/// The nearest first, or, of materials that were not searched for, that of the best evidence; but of those
/// that are within error of the best the one with the fewest parameters comes first. Sets the probabilities.
void put_in_order(std::vector<RankedMaterial>& materials);

}  // namespace patina
