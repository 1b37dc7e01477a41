#pragma once

#include <string>

#include "engine/comparison/rank_materials.h"

namespace patina {

/// "leather, 12 times likelier than plaster, the next": what a ranking found, in one or two sentences for
/// people who know no evidences.
std::string in_words(const MaterialRanking& ranking);

/// The standard deviation of a log evidence, or what Laplace's approximation is taken to be off by.
double error_of(const RankedMaterial& material);

/// Log probability, up to a constant that all materials share: evidence and glance.
double log_odds(const RankedMaterial& material);

/// Whether the better of two could be the worse one: their errors, or the crudeness of Laplace's
/// approximation where one has none, cover the difference.
bool within_error(const RankedMaterial& a, const RankedMaterial& b);

/// Log likelihood of all quarters of the photo.
double foretold(const RankedMaterial& material);

/// Whether a foretells the photo's quarters worse than b, by more than twice the standard error of four.
bool foretells_worse(const RankedMaterial& a, const RankedMaterial& b);

/// Most probable first; but of those that are within error of the best, and foretell the photo's quarters no
/// worse than the best of these at that, the one with the fewest parameters comes first. Sets the
/// probabilities.
void put_in_order(std::vector<RankedMaterial>& materials);

}  // namespace patina
