#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/cli/arguments.h"
#include "engine/cli/command.h"
#include "engine/cli/print.h"
#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/material/registry.h"
#include "engine/run/run_settings.h"
#include "engine/run/threads.h"
#include "engine/sampling/kernels.h"
#include "engine/stress/report.h"
#include "engine/stress/scenarios.h"

namespace patina {
namespace {

struct StressOptions {
  std::string material, scenario;
  std::vector<std::string> kernels;
  std::filesystem::path out;
  std::uint64_t seed = 1;
  int threads = hardware_threads();
  bool json = false;
};

/// The densities, or the photos of a material; all or the one of that name. @throws UserError
std::vector<Scenario> chosen_scenarios(const StressOptions& options) {
  if (!options.material.empty()) material_table(options.material);  // refuses an unknown name
  std::vector<Scenario> scenarios =
      options.material.empty() ? density_scenarios() : photo_scenarios(options.material);
  if (options.scenario.empty()) return scenarios;
  std::string known;
  for (const Scenario& scenario : scenarios) known += (known.empty() ? "" : ", ") + scenario.name;
  std::erase_if(scenarios, [&](const Scenario& scenario) { return scenario.name != options.scenario; });
  if (scenarios.empty())
    throw UserError("There is no scenario '" + options.scenario + "': use one of " + known + ".");
  return scenarios;
}

/// Photos of a smooth material are tried as runs draw that are told nothing, too.
std::vector<std::string> chosen_kernels(const StressOptions& options) {
  if (!options.kernels.empty()) return options.kernels;
  std::vector<std::string> kernels = kernel_names();
  if (options.material.empty()) return kernels;
  const ParameterTable table = material_table(options.material);
  if (table.discrete.empty() && std::ranges::none_of(table.continuous, &Parameter::jagged))
    kernels.push_back(kAuto);
  return kernels;
}

/// Into the page that is there, between its marks, or as a page of its own.
void write_table(const StressOptions& options, const std::string& table) {
  std::error_code ignored;
  const bool there = std::filesystem::exists(options.out, ignored);
  const std::string command =
      "patina-cli stress" + (options.material.empty() ? "" : " --material " + options.material);
  write_file_atomically(options.out,
                        with_table(there ? read_file(options.out) : std::string(), command, table));
}

/// The exit status: 1 if an answer is wrong and nothing said so.
int status_of(const std::vector<Cell>& cells) {
  const auto silent = std::ranges::count_if(cells, &Cell::is_defect);
  if (silent == 0) return kDone;
  std::fprintf(stderr, "patina-cli: %td of %td answers are wrong, and nothing said so.\n", silent,
               std::ssize(cells));
  return kRunFailed;
}

int stress(const StressOptions& options) {
  if (options.threads < 1) throw UserError("--threads must be at least 1.");
  if (options.material.empty() && std::ranges::count(options.kernels, kAuto) > 0)
    throw UserError("The kernel auto is of runs on photos: give --material, too, or name another kernel.");
  SuiteSettings settings;
  settings.kernels = chosen_kernels(options);
  settings.seed = options.seed;
  settings.threads = options.threads;
  settings.tried = [](const Cell& cell) {
    std::fprintf(stderr, "%s, %s: %s\n", cell.scenario.c_str(), cell.kernel.c_str(), cell_text(cell).c_str());
  };
  const std::vector<Cell> cells = try_all(chosen_scenarios(options), settings);
  const std::string table = report_table(cells);
  if (!options.out.empty()) write_table(options, table);
  if (options.json)
    print(report_json(cells));
  else if (options.out.empty())
    print(table);
  return status_of(cells);
}

}  // namespace

void add_stress(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<StressOptions>();
  CLI::App& command = *app.add_subcommand(
      "stress", "Known ways to fail, with every kernel: right, alarmed, refused, or silently wrong (exit 1)");
  command
      .add_option("--material", options->material,
                  "Try good and poor photos of this material in place of the densities")
      ->type_name("NAME");
  std::vector<std::string> names = kernel_names();
  names.push_back(kAuto);
  command
      .add_option("--kernel", options->kernels, "These kernels alone: mh, mala, hmc, nuts, auto (of photos)")
      ->type_name("NAME")
      ->check(CLI::IsMember(names));
  command.add_option("--scenario", options->scenario, "One scenario alone")->type_name("NAME");
  command.add_option("--seed", options->seed, "Seed of everything drawn")
      ->capture_default_str()
      ->check(seed_problem);
  command.add_option("--threads", options->threads, "Scenarios at a time")->capture_default_str();
  command.add_flag("--json", options->json, "Print the result as one JSON document");
  command
      .add_option("--out", options->out,
                  "Markdown file for the table, put between its marks if it has them (default: print it)")
      ->type_name("FILE.md");
  command.callback([options, &chosen] { chosen = [options] { return stress(*options); }; });
}

}  // namespace patina
