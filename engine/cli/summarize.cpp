#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/cli/command.h"
#include "engine/cli/print.h"
#include "engine/cli/summary_text.h"
#include "engine/error.h"
#include "engine/run/run.h"

namespace patina {
namespace {

struct Options {
  std::filesystem::path directory;
  bool json = false;
};

int summarize(const Options& options) {
  const auto run = open_run(options.directory);
  const std::vector<Draw> draws = run->take_draws();
  if (std::ranges::all_of(draws, &Draw::warmup))
    throw UserError("The run in " + options.directory.string() + " has no draws after warm-up (" +
                    run->status().message + "): wait, or export its best match with --draw map.");
  options.json ? print(summary_json(*run, draws)) : print(summary_table(*run, draws));
  return kDone;
}

}  // namespace

void add_summarize(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "summarize", "Mean, sd, quantiles, MCSE, ESS and R-hat of every parameter; acceptance of every chain");
  command.add_option("RUN_DIR", options->directory, "A run directory, also one that still grows")->required();
  command.add_flag("--json", options->json, "As one JSON document");
  command.callback([options, &chosen] { chosen = [options] { return summarize(*options); }; });
}

}  // namespace patina
