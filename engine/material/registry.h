#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/material/parameter.h"

namespace patina {

class Material;

/// Names of all materials, in the order in which they are shown.
std::vector<std::string> material_names();

/// @throws UserError for an unknown name (the sentence lists the known ones) or a broken prior file.
std::shared_ptr<const Material> make_material(const std::string& name);

/// The material's parameter table alone.
ParameterTable material_table(const std::string& name);

}  // namespace patina
