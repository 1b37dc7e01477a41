#include "engine/material/prior_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

/// Reads one file, naming it and the field in every complaint.
class PriorFile {
 public:
  explicit PriorFile(const std::filesystem::path& file) : file_(file) {}

  ParameterTable read(const Signature& signature) {
    const Json json = Json::parse(read_file(file_, 1u << 20), nullptr, false);
    if (!json.is_object()) refuse("it is not JSON");
    ParameterTable table;
    table.material = text(json, "material");
    if (table.material != file_.stem()) refuse("it is about '" + table.material + "'");
    table.description = text(json, "description");
    if (json.contains("summary")) table.summary = text(json, "summary");
    for (const Json& parameter : list(json, "parameters"))
      table.continuous.push_back(read_parameter(parameter));
    for (const Json& choice : list(json, "choices")) table.discrete.push_back(read_choice(choice));
    check(table, signature);
    for (Parameter& parameter : table.continuous) {
      parameter.jagged = std::ranges::count(signature.jagged, parameter.name) > 0;
      parameter.place = std::ranges::count(signature.places, parameter.name) > 0;
    }
    return table;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw UserError("The material file " + file_.string() + " cannot be used: " + why +
                    "; mend it or reinstall Patina.");
  }

  std::string text(const Json& json, const char* key) const {
    if (!json.is_object() || !json.contains(key) || !json[key].is_string())
      refuse(std::string("it lacks the text '") + key + "'");
    return json[key];
  }

  const Json& list(const Json& json, const char* key) const {
    if (!json.is_object() || !json.contains(key) || !json[key].is_array())
      refuse(std::string("it lacks the list '") + key + "'");
    return json[key];
  }

  std::string new_name(const Json& json) {
    const std::string name = text(json, "name");
    if (!names_.insert(name).second) refuse("it has '" + name + "' twice");
    return name;
  }

  Parameter read_parameter(const Json& json) {
    Parameter parameter;
    parameter.name = new_name(json);
    parameter.unit = text(json, "unit");
    parameter.description = text(json, "description");
    const Json& prior = list(json, "prior");
    if (prior.size() != 4 || !prior[0].is_number() || !prior[1].is_number() || !prior[2].is_number() ||
        !prior[3].is_number())
      refuse("the prior of '" + parameter.name + "' is not [mean, sd, low, high]");
    parameter.prior = {prior[0], prior[1], prior[2], prior[3]};
    if (!(parameter.prior.sd > 0) || !(parameter.prior.low < parameter.prior.high))
      refuse("the prior of '" + parameter.name + "' needs an sd above 0 and low below high");
    if (json.contains("camera_power")) {
      const Json& power = json["camera_power"];
      if (!power.is_number() || !(std::abs(power.get<double>()) <= 4))
        refuse("the camera_power of '" + parameter.name + "' is not a number from -4 to 4");
      parameter.camera_power = power;
    }
    if (json.contains("off")) {
      const Json& off = json["off"];
      if (!off.is_number() || off < parameter.prior.low || off > parameter.prior.high)
        refuse("'off' of '" + parameter.name + "' is not a number in the prior's range");
      parameter.off = off;
    }
    return parameter;
  }

  DiscreteParameter read_choice(const Json& json) {
    DiscreteParameter choice;
    choice.name = new_name(json);
    choice.description = text(json, "description");
    for (const Json& level : list(json, "levels")) {
      if (!level.is_string()) refuse("a level of '" + choice.name + "' is not a text");
      choice.levels.push_back(level);
    }
    if (choice.levels.empty()) refuse("'" + choice.name + "' has no levels");
    return choice;
  }

  void check(const ParameterTable& table, const Signature& signature) const {
    if (table.continuous.size() != signature.parameters.size())
      refuse("it has " + std::to_string(table.continuous.size()) + " parameters, not " +
             std::to_string(signature.parameters.size()));
    for (std::size_t i = 0; i < signature.parameters.size(); ++i)
      if (table.continuous[i].name != signature.parameters[i])
        refuse("it has '" + table.continuous[i].name + "' where '" + std::string(signature.parameters[i]) +
               "' belongs");
    if (table.discrete.size() != signature.choices.size())
      refuse("it has " + std::to_string(table.discrete.size()) + " choices, not " +
             std::to_string(signature.choices.size()));
    for (std::size_t i = 0; i < signature.choices.size(); ++i) {
      const auto& [name, levels] = signature.choices[i];
      if (table.discrete[i].name != name ||
          table.discrete[i].levels.size() > static_cast<std::size_t>(levels))
        refuse("its choice '" + table.discrete[i].name + "' must be '" + std::string(name) +
               "' with at most " + std::to_string(levels) + " levels");
    }
  }

  std::filesystem::path file_;
  std::set<std::string> names_;
};

}  // namespace

ParameterTable read_parameter_table(const std::filesystem::path& file, const Signature& signature) {
  return PriorFile(file).read(signature);
}

}  // namespace patina
