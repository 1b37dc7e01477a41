#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/cli/command.h"
#include "engine/cli/print.h"
#include "engine/format.h"
#include "engine/material/registry.h"
#include "engine/run/table_json.h"

namespace patina {
namespace {

struct MaterialsOptions {
  std::string name;
  bool json = false;
};

std::string line_of(const Parameter& parameter) {
  const TruncatedNormal& prior = parameter.prior;
  return format("  %-12s %8g %8g %8g %8g  %-10s ", parameter.name.c_str(), prior.mean, prior.sd, prior.low,
                prior.high, parameter.unit.c_str()) +
         parameter.description + "\n";
}

std::string line_of(const DiscreteParameter& parameter) {
  std::string text = "  " + parameter.name + ": " + parameter.description + "; levels";
  for (std::size_t i = 0; i < parameter.levels.size(); ++i)
    text += (i == 0 ? " " : ", ") + std::to_string(i) + " = " + parameter.levels[i];
  return text + "\n";
}

std::string describe(const ParameterTable& table) {
  std::string text = table.material + ": " + table.description + "\n";
  text += "  summary: " + table.summary + "\n";
  text += "  parameter        mean       sd      low     high  unit\n";
  for (const Parameter& parameter : table.continuous) text += line_of(parameter);
  for (const DiscreteParameter& parameter : table.discrete) text += line_of(parameter);
  return text;
}

int list_all(bool json) {
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  std::string text;
  for (const std::string& name : material_names()) {
    const ParameterTable table = material_table(name);
    tables.push_back(table_json(table));
    text += table.material + ": " + table.description + "\n";
  }
  json ? print({{"materials", tables}}) : print(text);
  return kDone;
}

int materials(const MaterialsOptions& options) {
  if (options.name.empty()) return list_all(options.json);
  const ParameterTable table = material_table(options.name);
  options.json ? print(table_json(table)) : print(describe(table));
  return kDone;
}

}  // namespace

void add_materials(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<MaterialsOptions>();
  CLI::App& command = *app.add_subcommand("materials", "The models, their parameters, units and priors");
  command.add_option("NAME", options->name, "One material, with all its parameters");
  command.add_flag("--json", options->json, "As one JSON document");
  command.callback([options, &chosen] { chosen = [options] { return materials(*options); }; });
}

}  // namespace patina
