#pragma once

#include <string>
#include <vector>

#include "engine/run/draw_source.h"

namespace patina {

/// One point of a run: "map", the mode that the search found; "mean", the mean of the draws after warm-up
/// (the most frequent level of discrete parameters); "CHAIN:DRAW", both counted from 1 as in the window, the
/// draw being its row in chain-CHAIN.csv, warm-up included.
/// @param draws  all of the run's draws so far
/// @throws UserError if there is no such draw
ParameterValues choose_draw(const std::string& choice, const DrawSource& run, const std::vector<Draw>& draws);

}  // namespace patina
