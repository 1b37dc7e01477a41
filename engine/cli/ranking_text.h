#pragma once

#include <functional>
#include <string>

#include "engine/comparison/rank_materials.h"

namespace patina {

/// A line for each material, the preferred first, and the sentence.
std::string ranking_table(const MaterialRanking& ranking);

/// Says on stderr what a ranking is doing, a line whenever that changes; nothing if quiet.
std::function<void(double fraction, const std::string& doing)> ranking_progress(bool quiet);

}  // namespace patina
