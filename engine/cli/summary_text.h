#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/run/draw_source.h"
#include "engine/run/summarize.h"

namespace patina {

/// A run as one JSON object: "directory", "phase", "message", "material", "draws" (after warm-up), "map"
/// ({"values", "lp"} or null), "lp" and "parameters" (by name) with mean, sd, quantiles, MCSE, ESS and R-hat,
/// "chains", and "advice": what the photo does not need or pin down (run/advice.h). Undefined numbers are
/// null. @param draws  after warm-up at least
nlohmann::ordered_json summary_json(const DrawSource& run, const std::vector<Draw>& draws);

/// The same as a table to read.
std::string summary_table(const DrawSource& run, const std::vector<Draw>& draws);

}  // namespace patina
