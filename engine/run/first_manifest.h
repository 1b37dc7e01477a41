#pragma once

#include "engine/io/photo.h"
#include "engine/run/manifest.h"

namespace patina {

/// What run.json says of a run before its search has found anything: what it was asked, of which photo, by
/// which program, network and hand-set errors.
/// @param table  with the priors in force
/// @throws UserError if the network cannot be read
Manifest first_manifest(const RunSettings& settings, const Photo& photo, const ParameterTable& table);

}  // namespace patina
