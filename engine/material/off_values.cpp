#include "engine/material/off_values.h"

#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/material/registry.h"

namespace patina {

std::map<std::string, double> off_values(const std::string& material) {
  const ParameterTable table = material_table(material);  // has checked the file's form
  const auto file = data_directory() / "materials" / (material + ".json");
  const auto parameters = nlohmann::json::parse(read_file(file, 1u << 20))["parameters"];
  std::map<std::string, double> off;
  for (std::size_t i = 0; i < table.continuous.size(); ++i) {
    if (!parameters[i].contains("off")) continue;
    const Parameter& parameter = table.continuous[i];
    const auto& value = parameters[i]["off"];
    if (!value.is_number() || value < parameter.prior.low || value > parameter.prior.high)
      throw UserError("The material file " + file.string() + " cannot be used: 'off' of '" + parameter.name +
                      "' is not a number in the prior's range; mend it or reinstall Patina.");
    off[parameter.name] = value;
  }
  return off;
}

}  // namespace patina
