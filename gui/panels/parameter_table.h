#pragma once

#include <optional>

#include "engine/material/parameter.h"
#include "engine/run/summarize.h"

namespace patina {

/// A table of a material's parameters in the current ImGui window: name, the prior's range with what the
/// posterior left of it and where `values` lie, posterior mean and sd, R-hat.
/// @param summary  of the draws after warm-up; none yet: the priors alone are shown
/// @param values   the point whose render is shown
void draw_parameter_table(const ParameterTable& table, const std::optional<RunSummary>& summary,
                          const ParameterValues& values);

}  // namespace patina
