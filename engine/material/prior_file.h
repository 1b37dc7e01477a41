#pragma once

#include <filesystem>

#include "engine/material/parameter.h"

namespace patina {

/// Reads a material's parameters, priors and discrete choices from its JSON file
/// (resources/materials/README.md).
/// @throws UserError that names the file and the field, for anything missing, misspelt or impossible
ParameterTable read_parameter_table(const std::filesystem::path& file);

}  // namespace patina
