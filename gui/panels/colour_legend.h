#pragma once

#include "gui/plot/draw_colours.h"

namespace patina {

/// A line of text that says what the draws' colours mean: a scale with its ends, the chains, the levels of a
/// choice, or how many draws there are.
/// @param density  the plot shows a map of how many draws there are, for they are too many to tell apart
void draw_colour_legend(const ExplorerModel& model, const DrawColours& colours, bool density);

/// A choice of what the colours tell, so wide. @return whether it was changed
bool choose_colouring(const char* id, float width, const ParameterTable& table, Colouring& colouring);

}  // namespace patina
