#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/calibration/outcome_file.h"
#include "engine/calibration/report.h"
#include "engine/cli/arguments.h"
#include "engine/cli/command.h"
#include "engine/cli/print.h"
#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/material/registry.h"
#include "engine/run/run_checks.h"
#include "engine/run/threads.h"
#include "engine/sampling/parallel_for.h"

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  StudySettings study;
  std::string errors = "calibrated";
  int photos = 100, threads = 1;
  std::filesystem::path out;
  bool json = false, quiet = false;
};

StudySettings study_of(const Options& options) {
  StudySettings study = options.study;
  check_material_argument(study.posterior.material);
  check_resolution(study.posterior.resolution);
  if (options.photos < 1 || options.photos > 99'999) throw UserError("--photos must be from 1 to 99999.");
  if (options.threads < 1 || options.threads > 1000) throw UserError("--threads must be from 1 to 1000.");
  if (study.chains < 2 || study.draws < 20 || study.warmup < 20)
    throw UserError("--chains must be at least 2, --draws and --warmup at least 20.");
  study.calibrated = options.errors == "calibrated";
  if (study.posterior.summary.empty())
    study.posterior.summary = material_table(study.posterior.material).summary;
  return study;
}

std::string title_of(const StudySettings& study) {
  return study.posterior.material + " at " + std::to_string(study.posterior.resolution) +
         " pixels, summary " + study.posterior.summary + ", errors " +
         (study.calibrated ? "calibrated" : "paper");
}

/// All that decides an outcome.
std::string study_text(const StudySettings& study) {
  std::string text = title_of(study) + "; seed " + std::to_string(study.seed) + "; " +
                     std::to_string(study.chains) + " chains; " + std::to_string(study.warmup) +
                     " iterations of warm-up; " + std::to_string(study.draws) + " draws";
  for (const auto& [name, value] : study.posterior.fixed) text += "; " + name + " " + std::to_string(value);
  return text;
}

void make_missing(const CalibrationStudy& study, const Options& options, OutcomeFile& file) {
  std::vector<int> missing;
  for (int photo = 1; photo <= options.photos; ++photo)
    if (!file.has(photo)) missing.push_back(photo);
  std::mutex mutex;
  const auto work = [&](std::size_t i) {
    PhotoOutcome outcome = study.run(missing[i]);
    const std::lock_guard lock(mutex);
    if (!options.quiet)
      std::fprintf(stderr, "photo %d of %d: %.1f s, R-hat %.3f, %.0f effective draws\n", outcome.photo,
                   options.photos, outcome.seconds, outcome.worst_rhat, outcome.least_ess);
    file.add(std::move(outcome));
  };
  parallel_for(missing.size(), options.threads, work, [] { use_tensor_threads(1); });
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json quantity_json(const QuantityCoverage& quantity) {
  Json intervals = Json::array();
  for (std::size_t i = 0; i < kIntervals.size(); ++i)
    intervals.push_back({{"interval", kIntervals[i]},
                         {"coverage", quantity.coverage.share[i]},
                         {"error", quantity.coverage.error(i)}});
  return {{"sd_over_prior_sd", number(quantity.sd_over_prior_sd)},
          {"identified", quantity.identified},
          {"intervals", intervals},
          {"p_uniform", quantity.coverage.uniformity}};
}

Json report_json(const CalibrationReport& report, const StudySettings& study) {
  Json quantities = Json::object();
  for (const QuantityCoverage& quantity : report.quantities)
    quantities[quantity.name] = quantity_json(quantity);
  return {{"study", study_text(study)},        {"photos", report.photos},
          {"converged", report.converged},     {"worst_rhat", number(report.worst_rhat)},
          {"seconds_a_photo", report.seconds}, {"quantities", quantities}};
}

int calibrate(const Options& options) {
  const StudySettings settings = study_of(options);
  use_tensor_threads(1);
  make_folder(options.out);
  const CalibrationStudy study(settings);
  OutcomeFile file(options.out / "photos.csv", study_text(settings), study.quantities());
  make_missing(study, options, file);
  const CalibrationReport report = report_of(study.quantities(), file.outcomes());
  const std::string table = to_markdown(report, title_of(settings));
  write_file_atomically(options.out / "calibration.md", table);
  options.json ? print(report_json(report, settings)) : print(table);
  return kDone;
}

}  // namespace

void add_calibrate(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  options->study.posterior.material.clear();
  options->study.posterior.summary.clear();
  options->study.posterior.resolution = 64;
  CLI::App& command = *app.add_subcommand(
      "calibrate", "How often intervals hold the truth, over synthetic photos of draws from the prior");
  command.add_option("--material", options->study.posterior.material, "The material's name")
      ->type_name("NAME");
  command
      .add_option("--out", options->out,
                  "Folder for photos.csv and calibration.md; photos that it has are not made again")
      ->type_name("DIR")
      ->required();
  command.add_option("--errors", options->errors, "Error model: paper (set by hand) or calibrated")
      ->check(CLI::IsMember({"paper", "calibrated"}))
      ->capture_default_str();
  command.add_option("--photos", options->photos, "Number of synthetic photos")->capture_default_str();
  command
      .add_option("--resolution", options->study.posterior.resolution,
                  "Pixels a side at which renders are compared with a photo")
      ->capture_default_str();
  command
      .add_option("--summary", options->study.posterior.summary,
                  "What renders and photo are compared by (default: the material's)")
      ->type_name("NAME");
  command.add_option("--chains", options->study.chains, "Chains a photo")->capture_default_str();
  command.add_option("--warmup", options->study.warmup, "Warm-up iterations of each chain")
      ->capture_default_str();
  command.add_option("--draws", options->study.draws, "Draws of each chain")->capture_default_str();
  command.add_option("--seed", options->study.seed, "Seed of everything drawn")
      ->capture_default_str()
      ->check(seed_problem);
  command.add_option("--threads", options->threads, "Photos at a time")->capture_default_str();
  command.add_flag("--json", options->json, "Print the report as one JSON document");
  command.add_flag("--quiet", options->quiet, "Print nothing but the report and errors");
  command.callback([options, &chosen] { chosen = [options] { return calibrate(*options); }; });
}

}  // namespace patina
