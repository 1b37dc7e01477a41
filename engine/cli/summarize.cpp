#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/cli/command.h"
#include "engine/cli/picture_text.h"
#include "engine/cli/print.h"
#include "engine/cli/summary_text.h"
#include "engine/error.h"
#include "engine/run/run.h"

namespace patina {
namespace {

struct SummarizeOptions {
  std::filesystem::path directory;
  bool json = false, picture = false;
};

NeededPicture compare_pictures(const DrawSource& run, const std::vector<Draw>& draws) {
  return needed_picture(in_force(run.settings(), run.status()), run.photo(), draws, kUsualPairs,
                        [](const std::string& doing) { std::fprintf(stderr, "trying %s\n", doing.c_str()); });
}

int summarize(const SummarizeOptions& options) {
  const auto run = open_run(options.directory);
  const std::vector<Draw> draws = run->take_draws();
  if (std::ranges::all_of(draws, &Draw::warmup))
    throw UserError("The run in " + options.directory.string() + " has no draws after warm-up (" +
                    run->status().message + "): wait, or export its best match with --draw map.");
  if (options.json) {
    nlohmann::ordered_json summary = summary_json(*run, draws);
    if (options.picture) summary["picture"] = picture_json(compare_pictures(*run, draws));
    print(summary);
  } else {
    print(summary_table(*run, draws));
    if (options.picture) print(picture_table(compare_pictures(*run, draws)));
  }
  return kDone;
}

}  // namespace

void add_summarize(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<SummarizeOptions>();
  CLI::App& command = *app.add_subcommand(
      "summarize", "Mean, sd, quantiles, MCSE, ESS and R-hat of every parameter; acceptance of every chain");
  command.add_option("RUN_DIR", options->directory, "A run directory, also one that still grows")->required();
  command.add_flag("--picture", options->picture,
                   "Also say how many pixels and levels of the network this photo needs, from some draws "
                   "evaluated with fewer; takes up to a minute");
  command.add_flag("--json", options->json, "As one JSON document");
  command.callback([options, &chosen] { chosen = [options] { return summarize(*options); }; });
}

}  // namespace patina
