#include "engine/cli/fit_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <type_traits>

#include "engine/error.h"
#include "engine/io/params_json.h"
#include "engine/material/capture_priors.h"
#include "engine/material/off_values.h"
#include "engine/material/registry.h"
#include "engine/run/advice.h"
#include "engine/run/chain_start.h"
#include "engine/run/manifest.h"
#include "engine/run/needed_picture.h"
#include "engine/run/run.h"
#include "engine/run/run_files.h"

namespace patina {

/// An option for one setting; seeds are checked by hand.
template <typename T>
void FitOptions::add(CLI::App& command, const std::string& names, T RunSettings::*setting,
                     const std::string& help, const std::string& type) {
  CLI::Option* option = command.add_option(names, parsed_.*setting, help);
  if (type.empty())
    option->capture_default_str();
  else
    option->type_name(type);
  if constexpr (std::is_same_v<T, std::uint64_t>) option->check(seed_problem);
  given_.push_back([this, option, setting](RunSettings& settings) {
    if (option->count() > 0) settings.*setting = parsed_.*setting;
  });
}

void FitOptions::add_to(CLI::App& command) {
  parsed_.material.clear();
  command.add_option("PHOTO", photo, "Flash photo of a flat sample, seen from above")->required();
  command.add_option("--out", out, "Run directory to make")->type_name("RUN_DIR")->required();
  command
      .add_option("--crop", crop_,
                  "Square of the photo to use, in its pixels from the top left (default: the central square)")
      ->type_name("X,Y,SIDE");
  add_model(command);
  add_sampler(command);
  add_counts(command);
  add_stop_rules(command);
  command.add_flag("--map-only", parsed_.map_only,
                   "Stop when the best match is found, by --errors paper unless others are asked for");
  command.add_flag("--resume", resume,
                   "Go on with the run in RUN_DIR, to the draws that it would have made undisturbed; with a "
                   "larger --draws also after its end. Starts it if there is none");
  command.add_flag("--quiet", quiet, "Print nothing but errors (and --json)");
  command.add_flag("--json", json, "Print the result as one JSON document");
}

void FitOptions::add_model(CLI::App& command) {
  add(command, "--material", &RunSettings::material,
      "The material's name, or auto: the one that patina-cli compare prefers", "NAME|auto");
  add(command, "--summary", &RunSettings::summary,
      "What renders and photo are compared by: gram, covariances, rings, bands, means, or several joined "
      "by + (default: the material's)",
      "NAME");
  add(command, "--network", &RunSettings::network, "Weights of the summary's network (default: bundled)",
      "FILE");
  add(command, "--precision", &RunSettings::precision,
      "What the network multiplies in: float32, or bfloat16, less exact and several times as fast on "
      "processors "
      "that are made for it");
  add(command, "--device", &RunSettings::device,
      "What the network runs on: cpu, or cuda, a graphics card, where Patina was built with a libtorch for "
      "it");
  add(command, "--errors", &RunSettings::errors,
      "What renders may be off by: auto (averaged where a material has places of a texture, as leather, "
      "plaster, wood and flake have, else paper), paper (set by hand), averaged (and by what a photo's "
      "irregularities do, renders being averaged over theirs) or calibrated (learnt from simulated photos; "
      "only where the photo is not like these is the best match searched for)");
  add(command, "--resolution", &RunSettings::resolution,
      "Pixels a side at which renders are compared with the photo (with --map-only: " +
          std::to_string(kMatchResolution) + ")");
  capture_.add_to(command);
  command.add_option("--fix", fixed_, "Hold a parameter at a value (repeatable)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--freeze", freeze_,
                  "Begin a new run as the one in RUN_DIR was, but hold what its photo does not need or pin "
                  "down (as summarize advises), and begin at its best match")
      ->type_name("RUN_DIR");
  command
      .add_flag("--picture", picture_,
                "With --freeze: also compare no more pixels and levels of the network than the photo needs "
                "(as summarize --picture finds)")
      ->needs("--freeze");
  command.add_option("--prior", priors_, "Replace a parameter's prior (repeatable)")
      ->type_name("NAME=MEAN,SD,LOW,HIGH")
      ->allow_extra_args(false);
}

void FitOptions::add_sampler(CLI::App& command) {
  add(command, "--kernel", &RunSettings::kernel,
      "Transition of the chains: mh, mala, hmc, nuts, emulated, whose proposals need no renders, or auto: "
      "emulated where renders follow polynomials about the match, else hmc");
  add(command, "--metric", &RunSettings::metric,
      "Covariance that warm-up learns: identity, diagonal, dense, or curved, which is dense where proposals "
      "are emulated");
  add(command, "--alpha", &RunSettings::alpha,
      "Share of continuous moves, where there are discrete parameters");
  add(command, "--refresh", &RunSettings::refresh,
      "Share of the continuous moves that refresh one parameter from its prior (default: 0.75 where a "
      "parameter is one that gradients do not move, else 0.25)",
      "SHARE");
  add(command, "--path-length", &RunSettings::path_length,
      "Mean length of hmc's trajectories, in standard deviations");
  add(command, "--temper", &RunSettings::temper,
      "Rungs of a ladder from prior to posterior that every chain travels, so that it finds matches far from "
      "each other, at about so many times the cost (2 to 64; 0: none)");
  command
      .add_option(
          "--start", start_,
          "Where chains begin: map (spread about the best match), predict (where a trained network guesses, "
          "without a global search), prior (a draw of it each), prior-mean, or a file of parameters as "
          "`export --format json` writes it (default: map)")
      ->type_name("WHERE|FILE");
  add(command, "--discrete", &RunSettings::discrete, "Proposal of discrete levels: joint, single");
}

void FitOptions::add_counts(CLI::App& command) {
  add(command, "--chains", &RunSettings::chains, "Number of chains");
  add(command, "--warmup", &RunSettings::warmup,
      "Warm-up iterations of each chain (default: 1500 where a parameter is one that gradients do not move, "
      "else 500; where proposals are emulated no more than 250 are made, of averages 30)");
  add(command, "--draws", &RunSettings::draws, "Draws of each chain after warm-up");
  add(command, "--seed", &RunSettings::seed, "Seed of the search and the chains");
  add(command, "--z-seed", &RunSettings::z_seed, "Seed of the irregularities");
}

void FitOptions::add_stop_rules(CLI::App& command) {
  const auto add_rule = [&](const char* name, double StopRules::*rule, const char* help) {
    CLI::Option* option = command.add_option(name, parsed_.stop.*rule, help)->capture_default_str();
    given_.push_back([this, option, rule](RunSettings& settings) {
      if (option->count() > 0) settings.stop.*rule = parsed_.stop.*rule;
    });
  };
  add_rule("--minutes", &StopRules::minutes, "End after so many minutes, search included (0: no limit)");
  add_rule("--ess", &StopRules::ess,
           "End when every identified parameter has so many effective draws, bulk and tail (0: do not ask)");
  add_rule("--rhat", &StopRules::rhat, "and no identified parameter's R-hat is above this (0: do not ask)");
}

void FitOptions::set_start(RunSettings& settings) const {
  if (start_.empty() || settings.material == kAutomatic) return;
  settings.start_at.clear();
  settings.start = start_;
  if (start_ != "values" && std::ranges::count(start_names(), start_) > 0) return;
  settings.start = "values";
  const ParameterTable table = table_under(material_table(settings.material), settings.capture);
  const ParameterValues values = read_params(start_, table, prior_location(table));
  for (std::size_t i = 0; i < table.continuous.size(); ++i)
    settings.start_at[table.continuous[i].name] = values.continuous[i];
  for (std::size_t i = 0; i < table.discrete.size(); ++i)
    settings.start_at[table.discrete[i].name] = values.discrete[i];
}

bool FitOptions::goes_on() const {
  std::error_code ignored;
  return resume && std::filesystem::exists(manifest_file(out), ignored);
}

std::optional<PhotoCrop> FitOptions::crop() const {
  if (!crop_.empty()) return parse_crop(crop_);
  if (goes_on()) return read_manifest(out).crop;
  return freeze_.empty() ? std::nullopt : read_manifest(freeze_).crop;
}

RankSettings FitOptions::rank_settings() const { return first_cut(parsed_, capture_.capture()); }

RunSettings FitOptions::frozen_settings() const {
  const auto run = open_run(freeze_);
  RunSettings settings = run->settings();
  const std::vector<Draw> draws = run->take_draws();
  const std::map<std::string, double> frozen =
      frozen_by(advise(run->table(), draws, off_values(settings.material)));
  const NeededPicture needed =
      picture_ ? needed_picture(in_force(settings, run->status()), run->photo(), draws) : NeededPicture{};
  if (const CheaperPicture* smaller = needed.cheapest()) {
    settings.resolution = smaller->resolution;
    settings.summary = smaller->summary;
  } else if (frozen.empty()) {
    throw UserError("The draws in " + freeze_.string() +
                    " show nothing that could be held without changing the rest: go on with that run.");
  }
  for (const auto& [name, value] : frozen) settings.fixed[name] = value;
  const ParameterTable& table = run->table();
  if (const std::optional<ParameterValues> best = run->status().best) {
    settings.start = "values";
    for (std::size_t i = 0; i < table.continuous.size(); ++i)
      settings.start_at[table.continuous[i].name] = best->continuous[i];
    for (std::size_t i = 0; i < table.discrete.size(); ++i)
      settings.start_at[table.discrete[i].name] = best->discrete[i];
  }
  return settings;
}

RunSettings FitOptions::settings(const std::string& chosen) const {
  const bool goes_on = this->goes_on();
  const bool freezes = !goes_on && !freeze_.empty();
  if (!goes_on && !freezes && parsed_.material != kAutomatic) check_material_argument(parsed_.material);
  RunSettings settings = goes_on ? read_manifest(out).settings : freezes ? frozen_settings() : parsed_;
  if (parsed_.map_only && !goes_on && !freezes) settings.resolution = kMatchResolution;
  const std::string material = goes_on ? settings.material : chosen;
  for (const auto& copy : given_) copy(settings);
  if (settings.material == kAutomatic && !material.empty()) settings.material = material;
  settings.map_only = parsed_.map_only;
  if (!(goes_on || freezes) || capture_.given()) settings.capture = capture_.capture();
  set_start(settings);
  if (!fixed_.empty() && !freezes) settings.fixed.clear();
  for (const std::string& text : fixed_) {
    const auto [name, value] = parse_assignment("--fix", text);
    settings.fixed.insert_or_assign(name, value);
  }
  if (!priors_.empty()) settings.priors.clear();
  for (const std::string& text : priors_) settings.priors.insert(parse_prior(text));
  return settings;
}

}  // namespace patina
