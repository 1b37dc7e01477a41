#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/chart/chart.h"
#include "engine/chart/photo_problem.h"
#include "engine/cli/arguments.h"
#include "engine/cli/command.h"
#include "engine/error.h"
#include "engine/io/photo.h"
#include "engine/run/run_checks.h"
#include "engine/run/run_settings.h"
#include "engine/run/threads.h"
#include "engine/run/version.h"

namespace patina {
namespace {

struct ChartOptions {
  std::filesystem::path photo, out;
  std::string preset = "quick";
  std::vector<std::string> only;  ///< empty: all of the preset
  RunSettings run;
  CaptureArguments capture;
  std::uint64_t seed = 1;
  double minutes_per_setting = 0.75, gold_minutes = 3;
  int repeats = 2, draws = 20000;
  int warmup = 0;  ///< 0: not given
  bool quiet = false;
};

void check(const ChartOptions& options) {
  check_material_argument(options.run.material);
  check_resolution(options.run.resolution);
  if (!(options.minutes_per_setting >= 0 && options.gold_minutes >= 0))
    throw UserError("Minutes cannot be less than none.");
  constexpr int kMostRepeats = 1000;
  if (options.repeats < 1 || options.repeats > kMostRepeats)
    throw UserError("--repeats must be from 1 to " + std::to_string(kMostRepeats) + ".");
  if (options.draws < 1 || options.draws > kMostIterations)
    throw UserError("--draws must be from 1 to " + std::to_string(kMostIterations) + ".");
  if (options.warmup < 0 || options.warmup > kMostIterations)
    throw UserError("--warmup must be from 1 to " + std::to_string(kMostIterations) + ".");
}

/// The photo, or the render that stands for it.
PhotoProblem problem_of(const ChartOptions& options) {
  RunSettings settings = options.run;
  settings.capture = options.capture.capture();
  if (!options.photo.empty()) {
    Photo photo = load_photo(options.photo);
    return {settings, std::move(photo.image), options.photo.filename().string()};
  }
  const std::uint64_t z_seed = settings.z_seed + 1;
  return {settings, photo_of_prior_draw(settings, options.seed, z_seed),
          "render of a prior draw (seed " + std::to_string(options.seed) + ") with irregularities " +
              std::to_string(z_seed)};
}

/// The default and those that are asked for. @throws UserError for a name that there is not
std::vector<ChartSetting> chosen(std::vector<ChartSetting> settings, const std::vector<std::string>& only) {
  const auto is_asked_for = [&](const ChartSetting& s) { return std::ranges::count(only, s.name) > 0; };
  for (const std::string& name : only)
    if (std::ranges::find(settings, name, &ChartSetting::name) == settings.end()) {
      std::string known;
      for (const ChartSetting& setting : settings)
        known += (known.empty() ? "'" : ", '") + setting.name + "'";
      throw UserError("There is no setting '" + name + "' for this target: use some of " + known + ".");
    }
  if (!only.empty())
    std::erase_if(settings,
                  [&](const ChartSetting& s) { return s.name != kDefaultSetting && !is_asked_for(s); });
  return settings;
}

int chart(const ChartOptions& options) {
  check(options);
  use_tensor_threads(hardware_threads());
  const PhotoProblem problem = problem_of(options);
  const std::vector<ChartSetting> settings =
      chosen(preset_settings(options.preset, problem.target()), options.only);
  const auto gold_kinds = std::ssize(gold_settings(settings.front()));
  ChartPlan plan = make_plan(settings, options.seed, 60 * options.minutes_per_setting / options.repeats,
                             options.draws, 60 * options.gold_minutes / gold_kinds, options.draws);
  if (options.warmup > 0) plan.settings = with_warmup(plan.settings, options.warmup);
  plan.gold.settings = with_warmup(plan.gold.settings, plan.settings.front().warmup);
  plan.repeats = options.repeats;
  plan.program = program_version();
  make_chart(problem, plan, options.out, [&](const std::string& line) {
    if (!options.quiet) std::fprintf(stderr, "%s\n", line.c_str());
  });
  return kDone;
}

void add_budget(CLI::App& command, ChartOptions& options) {
  command
      .add_option(
          "--minutes-per-setting", options.minutes_per_setting,
          "Wall time of each setting, shared by its repeats; search and warm-up included (0: no limit)")
      ->capture_default_str();
  command.add_option("--gold-minutes", options.gold_minutes, "Wall time of the gold standard (0: no limit)")
      ->capture_default_str();
  command.add_option("--repeats", options.repeats, "Repeats of each setting")->capture_default_str();
  command.add_option("--draws", options.draws, "Draws of each chain after warm-up, at most")
      ->capture_default_str();
  command.add_option(
      "--warmup", options.warmup,
      "Warm-up iterations of every chain (default: 500 of quick; of full 1500, and several others)");
}

/// Of what all settings draw from.
void add_target(CLI::App& command, ChartOptions& options) {
  command.add_option("--resolution", options.run.resolution, "Pixels a side of the target")
      ->capture_default_str();
  command.add_option("--summary", options.run.summary, "Summary of the target (default: the material's)")
      ->type_name("NAME");
  command.add_option("--network", options.run.network, "Weights of the summary's network (default: bundled)")
      ->type_name("FILE");
  command.add_option("--z-seed", options.run.z_seed, "Seed of the irregularities")
      ->capture_default_str()
      ->check(seed_problem);
}

}  // namespace

void add_chart(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ChartOptions>();
  options->run.material.clear();
  CLI::App& command = *app.add_subcommand(
      "chart", "Speed against accuracy of ways to draw from one posterior, under equal budgets");
  command.add_option("PHOTO", options->photo,
                     "Flash photo (default: a render of a draw from the material's prior, of --seed)");
  command.add_option("--material", options->run.material, "The material's name")->type_name("NAME");
  command
      .add_option(
          "--out", options->out,
          "Folder for chart.csv, chart.svg, chart.png, waiting.* and gold/; what it has is not made again")
      ->type_name("DIR")
      ->required();
  command.add_option("--preset", options->preset, "Settings to try: quick (about 10) or full (about 40)")
      ->check(CLI::IsMember(chart_presets()))
      ->capture_default_str();
  command
      .add_option(
          "--only", options->only,
          "A setting of the preset to try beside the default, and no others but those of further --only")
      ->type_name("NAME");
  command.add_option("--seed", options->seed, "Seed of everything drawn")
      ->capture_default_str()
      ->check(seed_problem);
  add_budget(command, *options);
  add_target(command, *options);
  options->capture.add_to(command);
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  command.callback([options, &chosen] { chosen = [options] { return chart(*options); }; });
}

}  // namespace patina
