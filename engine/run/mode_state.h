#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/run/mode_search.h"

namespace patina {

// What the search handed to the chains of a run, as a state file; see state_file.h.

/// @throws UserError if it cannot be written
void write_mode(const std::filesystem::path& directory, const std::string& run_key, ModeFound found,
                const RunSettings& settings);

/// Nothing if the search had not ended.
/// @param settings  of the run: whether its errors were learnt and its proposals are emulated
/// @throws UserError for a file that is damaged or not of that target
std::optional<ModeFound> read_mode(const std::filesystem::path& directory, const std::string& run_key,
                                   const Posterior& target, const RunSettings& settings);

/// @throws UserError for a run that has draws, or chains with a state, but not the mode that they started
/// from
void check_has_mode(const std::filesystem::path& directory);

}  // namespace patina
