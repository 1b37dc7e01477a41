#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/stress/suite.h"

namespace patina {

/// "right 0.04 +- 0.02": outcome, error in posterior sds with its Monte Carlo error, what was said.
std::string cell_text(const Cell& cell);

/// A Markdown table, a row per scenario and a column per kernel, and the count of each outcome below.
/// @param cells  as try_all() returns them
std::string report_table(const std::vector<Cell>& cells);

/// A page with the table in place of what stood between its lines "<!-- COMMAND -->" and "<!-- /COMMAND -->";
/// between them at its end where the page has no such lines.
/// @param command  that made the table
std::string with_table(const std::string& page, const std::string& command, const std::string& table);

/// {"cells": [{"scenario", "kernel", "outcome", "error", "mcse", "of", "warnings", "alarms", "seconds"}]}
nlohmann::ordered_json report_json(const std::vector<Cell>& cells);

}  // namespace patina
