#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "engine/cli/arguments.h"
#include "engine/cli/command.h"
#include "engine/cli/print.h"
#include "engine/cli/progress.h"
#include "engine/cli/summary_text.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/run.h"

namespace patina {
namespace {

struct Options {
  std::filesystem::path photo, out;
  RunSettings settings;
  CaptureArguments capture;
  std::vector<std::string> fixed, priors;
  bool quiet = false, json = false;
};

volatile std::sig_atomic_t interrupted = 0;

void interrupt(int) { interrupted = 1; }

/// A first Ctrl-C ends the run tidily, a second one at once.
void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = interrupt;
  action.sa_flags = SA_RESETHAND;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

RunSettings settings_of(const Options& options) {
  check_material_argument(options.settings.material);
  RunSettings settings = options.settings;
  settings.capture = options.capture.capture();
  for (const std::string& text : options.fixed) settings.fixed.insert(parse_assignment("--fix", text));
  for (const std::string& text : options.priors) settings.priors.insert(parse_prior(text));
  return settings;
}

/// Waits for the end; returns the draws after warm-up. A full disk pauses the run: it is tried again.
std::vector<Draw> attend(DrawSource& run, Progress& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kRetry(5);
  std::vector<Draw> kept;
  auto paused_since = Clock::time_point::max();
  for (;;) {
    const RunStatus status = run.status();
    std::ranges::copy_if(run.take_draws(), std::back_inserter(kept), [](const Draw& d) { return !d.warmup; });
    if (has_ended(status.phase)) return kept;
    if (interrupted) run.stop();
    progress.show(status);
    if (status.phase != RunPhase::paused) {
      paused_since = Clock::time_point::max();
    } else if (paused_since == Clock::time_point::max()) {
      paused_since = Clock::now();
    } else if (Clock::now() - paused_since > kRetry) {
      run.resume();
      paused_since = Clock::time_point::max();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void report(const Options& options, const DrawSource& run, const std::vector<Draw>& draws) {
  if (options.json) {
    const nlohmann::ordered_json summary = summary_json(run, draws);
    nlohmann::ordered_json document = {
        {"directory", summary["directory"]}, {"map", nullptr}, {"lp", nullptr}};
    if (const nlohmann::ordered_json& map = summary["map"]; !map.is_null()) {
      document["map"] = map["values"];
      document["lp"] = map["lp"];
    }
    document["summary"] = summary;
    print(document);
  } else if (!options.quiet && !draws.empty()) {
    print(summary_table(run, draws));
  }
}

int fit(const Options& options) {
  const RunSettings settings = settings_of(options);
  const Photo photo = load_photo(options.photo);
  if (!options.quiet)
    for (const std::string& warning : photo.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  catch_interrupts();
  const auto run = start_run(settings, photo, options.out);
  Progress progress(settings, options.quiet);
  const std::vector<Draw> draws = attend(*run, progress);
  const RunStatus status = run->status();
  if (status.phase == RunPhase::failed) {
    std::fprintf(stderr, "patina-cli: The run failed: %s\n", status.message.c_str());
    return kRunFailed;
  }
  progress.end(status);
  report(options, *run, draws);
  return kDone;
}

void add_counts(CLI::App& command, RunSettings& settings) {
  command.add_option("--chains", settings.chains, "Number of chains")->capture_default_str();
  command.add_option("--warmup", settings.warmup, "Warm-up iterations of each chain")->capture_default_str();
  command.add_option("--draws", settings.draws, "Draws of each chain after warm-up")->capture_default_str();
  command.add_option("--seed", settings.seed, "Seed of the search and the chains")
      ->capture_default_str()
      ->check(seed_problem);
  command.add_option("--z-seed", settings.z_seed, "Seed of the irregularities")
      ->capture_default_str()
      ->check(seed_problem);
  command
      .add_option("--resolution", settings.resolution,
                  "Pixels a side at which renders are compared with the photo")
      ->capture_default_str();
}

}  // namespace

void add_fit(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  options->settings.material.clear();
  RunSettings& settings = options->settings;
  CLI::App& command =
      *app.add_subcommand("fit", "Draw parameters of a material that could have made a photo");
  command.add_option("PHOTO", options->photo, "Flash photo of a flat sample, seen from above")->required();
  command.add_option("--out", options->out, "Run directory to make")->type_name("RUN_DIR")->required();
  command.add_option("--material", settings.material, "The material's name")->type_name("NAME");
  command
      .add_option("--summary", settings.summary,
                  "What renders and photo are compared by: gram, rings, bands, means, or several joined by + "
                  "(default: the material's)")
      ->type_name("NAME");
  command.add_option("--network", settings.network, "Weights of the summary's network (default: bundled)")
      ->type_name("FILE");
  command.add_option("--kernel", settings.kernel, "Transition of the chains: mh, mala, hmc, nuts")
      ->capture_default_str();
  command
      .add_option("--metric", settings.metric, "Covariance that warm-up learns: identity, diagonal, dense")
      ->capture_default_str();
  command.add_option("--discrete", settings.discrete, "Proposal of discrete levels: joint, single")
      ->capture_default_str();
  add_counts(command, settings);
  options->capture.add_to(command);
  command.add_option("--fix", options->fixed, "Hold a parameter at a value (repeatable)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option("--prior", options->priors, "Replace a parameter's prior (repeatable)")
      ->type_name("NAME=MEAN,SD,LOW,HIGH")
      ->allow_extra_args(false);
  command.add_flag("--map-only", settings.map_only, "Stop when the best match is found");
  command.add_flag("--quiet", options->quiet, "Print nothing but errors (and --json)");
  command.add_flag("--json", options->json, "Print the result as one JSON document");
  command.callback([options, &chosen] { chosen = [options] { return fit(*options); }; });
}

}  // namespace patina
