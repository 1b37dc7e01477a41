#pragma once

#include <map>
#include <string>

namespace patina {

/// The values at which a component of a material is not there: no glow, no fine grain, one roughness ... By
/// parameter, as the material's file has them ("off", resources/materials/README.md).
/// A run's own table need not hold them. @throws UserError for a material's file that cannot be used
std::map<std::string, double> off_values(const std::string& material);

}  // namespace patina
