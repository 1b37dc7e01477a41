#include "engine/io/params_json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

std::string known_names(const ParameterTable& table) {
  std::string names;
  const auto add = [&names](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const Parameter& parameter : table.continuous) add(parameter.name);
  for (const DiscreteParameter& parameter : table.discrete) add(parameter.name);
  return names;
}

/// Shortest text that reads back as the same double: a value just beyond a bound must not look like it.
std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

std::string params_to_json(const ParameterTable& table, const ParameterValues& values) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < table.continuous.size(); ++i)
    json[table.continuous[i].name] = values.continuous[i];
  for (std::size_t i = 0; i < table.discrete.size(); ++i) json[table.discrete[i].name] = values.discrete[i];
  return json.dump(2) + "\n";
}

void set_parameter(const ParameterTable& table, const std::string& name, double value,
                   ParameterValues& values) {
  if (const auto index = table.find_continuous(name)) {
    const TruncatedNormal& prior = table.continuous[*index].prior;
    if (!(value >= prior.low && value <= prior.high))
      throw UserError("The parameter " + name + " = " + number(value) + " is out of range: " +
                      table.material + " takes " + number(prior.low) + " to " + number(prior.high) + ".");
    values.continuous[*index] = value;
    return;
  }
  if (const auto index = table.find_discrete(name)) {
    const auto levels = static_cast<double>(table.discrete[*index].levels.size());
    if (!(value >= 0 && value < levels && value == std::floor(value)))
      throw UserError("The choice " + name + " = " + number(value) + " does not exist: " + table.material +
                      " takes a whole number from 0 to " + number(levels - 1) + ".");
    values.discrete[*index] = static_cast<int>(value);
    return;
  }
  throw UserError("The material " + table.material + " has no parameter '" + name + "': it has " +
                  known_names(table) + ".");
}

ParameterValues read_params(const std::filesystem::path& file, const ParameterTable& table,
                            ParameterValues defaults) {
  const std::string text = read_file(file, 1u << 20);
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object())
    throw UserError(file.string() + " is not a params file: it must be JSON like {\"rough\": 0.4}.");
  for (const auto& [name, value] : json.items()) {
    if (!value.is_number())
      throw UserError("The parameter " + name + " in " + file.string() + " is not a number: write it as \"" +
                      name + "\": 0.5.");
    set_parameter(table, name, value.get<double>(), defaults);
  }
  return defaults;
}

}  // namespace patina
