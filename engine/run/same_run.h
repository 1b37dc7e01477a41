#pragma once

#include <filesystem>
#include <string>

#include "engine/run/manifest.h"

namespace patina {

/// SHA-256 of everything that decides a run's draws: photo, geometry, material and priors, settings, weights,
/// error model, the program's version; not how many draws are made of it.
std::string run_key(const Manifest& manifest);

/// @param directory  of `made`, the run that is to be taken up again
/// @param asked      the run that is asked for now
/// @throws UserError unless both make the same draws, `asked` no fewer of them; names the first difference
void check_same_run(const std::filesystem::path& directory, const Manifest& made, const Manifest& asked);

}  // namespace patina
