#pragma once

#include <string>
#include <vector>

#include "engine/material/parameter.h"
#include "engine/run/draw.h"

namespace patina {

/// All draws after warm-up as one plain table: chain, draw (both from 1, as `export --draw` takes them), lp,
/// parameters. Numbers read back exactly.
std::string draws_csv(const ParameterTable& table, const std::vector<Draw>& draws);

}  // namespace patina
