#include "engine/material/off_values.h"

#include "engine/material/registry.h"

namespace patina {

std::map<std::string, double> off_values(const std::string& material) {
  std::map<std::string, double> off;
  for (const Parameter& parameter : material_table(material).continuous)
    if (parameter.off) off[parameter.name] = *parameter.off;
  return off;
}

}  // namespace patina
