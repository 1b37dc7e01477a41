#pragma once

#include <filesystem>

#include "engine/material/material.h"

namespace patina {

/// Reads a material's parameters, priors and discrete choices from its JSON file
/// (resources/materials/README.md).
/// @throws UserError that names the file and the field, for anything missing, misspelt, impossible, or not as
/// the material's code reads it
ParameterTable read_parameter_table(const std::filesystem::path& file, const Signature& signature);

}  // namespace patina
