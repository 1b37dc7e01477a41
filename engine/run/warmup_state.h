#pragma once

#include <filesystem>
#include <string>

#include "engine/run/warmup_meeting.h"
#include "engine/sampling/log_density.h"

namespace patina {

// What the chains of a run agreed on in warm-up, as a state file; see state_file.h.

/// @throws UserError if it cannot be written
void write_warmup(const std::filesystem::path& directory, const std::string& run_key, WarmupRecord record);

/// Empty if no window had ended. @param rungs  of the chains' ladders
/// @throws UserError for a file that is damaged or not of that target
WarmupRecord read_warmup(const std::filesystem::path& directory, const std::string& run_key,
                         const LogDensity& target, int rungs);

}  // namespace patina
