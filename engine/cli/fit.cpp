#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <vector>

#include "engine/cli/command.h"
#include "engine/cli/fit_options.h"
#include "engine/cli/print.h"
#include "engine/cli/progress.h"
#include "engine/cli/ranking_text.h"
#include "engine/cli/summary_text.h"
#include "engine/comparison/ranking_json.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/run.h"
#include "engine/run/run_checks.h"

namespace patina {
namespace {

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

void report(const FitOptions& options, const DrawSource& run, const std::vector<Draw>& draws) {
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

/// Of all materials, with a line on stderr about each.
MaterialRanking rank(const FitOptions& options, const Photo& photo) {
  if (!options.resume) check_holds_no_run(options.out);  // before the wait
  const MaterialRanking ranking =
      rank_materials(photo.image, options.rank_settings(), ranking_progress(options.quiet)).value();
  if (!options.quiet)
    std::fprintf(stderr, "%s\nfitting %s\n", ranking.sentence.c_str(),
                 ranking.materials.front().material.c_str());
  return ranking;
}

int fit(const FitOptions& options) {
  RunSettings settings = options.settings();
  const Photo photo = load_photo(options.photo, {.crop = options.crop()});
  if (!options.quiet)
    for (const std::string& warning : photo.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  std::optional<MaterialRanking> ranking;
  if (settings.material == kAutomatic) {
    ranking = rank(options, photo);
    settings = options.settings(ranking->materials.front().material);
  }
  catch_interrupts();
  const auto run =
      options.resume ? resume_run(settings, photo, options.out) : start_run(settings, photo, options.out);
  if (ranking) write_ranking(options.out, *ranking);
  Progress progress(run->settings(), options.quiet);
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

}  // namespace

void add_fit(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<FitOptions>();
  CLI::App& command =
      *app.add_subcommand("fit", "Draw parameters of a material that could have made a photo");
  options->add_to(command);
  command.callback([options, &chosen] { chosen = [options] { return fit(*options); }; });
}

}  // namespace patina
