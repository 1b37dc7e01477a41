#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/material/parameter.h"

namespace patina {

/// {"mean": ..., "sd": ..., "low": ..., "high": ...}
nlohmann::ordered_json prior_json(const TruncatedNormal& prior);

/// {"name", "description", "continuous": [{"name", "unit", "description", "prior"}],
///  "discrete": [{"name", "description", "levels": [...]}]}, as in run.json and `patina-cli materials --json`
nlohmann::ordered_json table_json(const ParameterTable& table);

}  // namespace patina
