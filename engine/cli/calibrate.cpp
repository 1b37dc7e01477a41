#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/calibration/outcome_file.h"
#include "engine/calibration/overall.h"
#include "engine/calibration/report.h"
#include "engine/cli/arguments.h"
#include "engine/cli/command.h"
#include "engine/cli/print.h"
#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/material/registry.h"
#include "engine/number_json.h"
#include "engine/run/run_checks.h"
#include "engine/run/threads.h"
#include "engine/sampling/parallel_for.h"

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

struct CalibrateOptions {
  StudySettings study;  ///< its material is the one that is next
  std::vector<std::string> materials;
  std::string summary;
  int photos = 100, threads = 1;
  std::filesystem::path out;
  bool json = false, quiet = false;
};

void check(const CalibrateOptions& options) {
  const StudySettings& study = options.study;
  for (const std::string& material : options.materials) check_material_argument(material);
  check_resolution(study.posterior.resolution);
  if (options.photos < 1 || options.photos > 99'999) throw UserError("--photos must be from 1 to 99999.");
  if (options.threads < 1 || options.threads > 1000) throw UserError("--threads must be from 1 to 1000.");
  if (study.camera.least_side < 0 || study.camera.least_side > 8192)
    throw UserError("--photo-pixels must be from 0 to 8192.");
  if (study.chains < 2 || study.draws < 20 || study.warmup < 20)
    throw UserError("--chains must be at least 2, --draws and --warmup at least 20.");
  if (!(study.error_scale > 0 && study.error_scale <= 100))
    throw UserError("--error-scale must be above 0 and at most 100.");
  if (study.simulations.pilot < 200)
    throw UserError("--pilot must be at least 200: fewer photos of the prior do not tell where to look.");
}

StudySettings study_of(const CalibrateOptions& options, const std::string& material) {
  StudySettings study = options.study;
  study.posterior.material = material;
  study.posterior.summary = options.summary.empty() ? material_table(material).summary : options.summary;
  return study;
}

std::string title_of(const StudySettings& study) {
  return study.posterior.material + ", errors " + study.errors;
}

/// All that decides an outcome, in a title and as the command has it.
std::string study_text(const StudySettings& study) {
  std::string text = title_of(study) + ": --resolution " + std::to_string(study.posterior.resolution) +
                     " --summary " + study.posterior.summary + " --seed " + std::to_string(study.seed) +
                     " --chains " + std::to_string(study.chains) + " --warmup " +
                     std::to_string(study.warmup) + " --draws " + std::to_string(study.draws);
  text += " --photo-pixels " + std::to_string(study.camera.least_side);
  if (study.errors == "calibrated") text += " --pilot " + std::to_string(study.simulations.pilot);
  if (study.error_scale != 1) text += " --error-scale " + std::to_string(study.error_scale);
  return text;
}

std::filesystem::path file_of(const CalibrateOptions& options, const StudySettings& study) {
  return options.out / (study.posterior.material + "-" + study.errors + ".csv");
}

void make_missing(const CalibrationStudy& study, const CalibrateOptions& options, OutcomeFile& file) {
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

Json quantity_json(const QuantityCoverage& quantity) {
  Json intervals = Json::array();
  for (std::size_t i = 0; i < kIntervals.size(); ++i)
    intervals.push_back({{"interval", kIntervals[i]},
                         {"coverage", quantity.coverage.share[i]},
                         {"error", quantity.coverage.error(i)}});
  return {{"sd_over_prior_sd", number_json(quantity.sd_over_prior_sd)},
          {"identified", quantity.identified},
          {"intervals", intervals},
          {"p_uniform", quantity.coverage.uniformity}};
}

Json report_json(const CalibrationReport& report, const std::string& study) {
  Json quantities = Json::object();
  for (const QuantityCoverage& quantity : report.quantities)
    quantities[quantity.name] = quantity_json(quantity);
  return {{"study", study},
          {"photos", report.photos},
          {"converged", report.converged},
          {"worst_rhat", number_json(report.worst_rhat)},
          {"seconds_a_photo", report.seconds},
          {"simulated_photos", report.simulated},
          {"quantities", quantities}};
}

/// All studies in a folder, by file name.
std::vector<OutcomeFile> studies_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<OutcomeFile> studies;
  for (const auto& file : files) studies.push_back(OutcomeFile::read(file));
  return studies;
}

constexpr const char* kIntroduction = R"(# Do intervals hold the truth?

Every photo below is made: parameters are drawn from the prior, rendered with irregularities that no run knows, and photographed (sensor
noise, 8 bits, JPEG) with twice the pixels that are compared or, unless a pixel is its middle anyway, --photo-pixels. A run explains the photo,
and the truth either lies in its interval or not. Of many photos a 90 % interval should hold 90 % (± the binomial standard error), and the
truth's rank among the draws should be uniform: its chi-square in ten bins has 9 degrees of freedom, p is that of a larger one. A parameter
is identified where its posterior's sd is on average below 0.9 of the prior's; **bold** is what is
identified and not covered 85 to 95 % by the 90 % interval. `lp` is the log posterior density, whose rank asks whether the likelihood is the
photos' own.

This page is written by

    patina-cli calibrate --out DIR --photos N [--errors calibrated|averaged|paper] [--material NAME]...

of all the tables in DIR, to which a photo is added as it is done; the options of each are in its title.

)";

std::string page_of(const std::vector<OutcomeFile>& studies) {
  std::vector<CalibrationReport> reports;
  std::string tables;
  for (const OutcomeFile& study : studies) {
    reports.push_back(report_of(study.quantities(), study.outcomes()));
    tables += "\n" + to_markdown(reports.back(), study.study());
  }
  return kIntroduction + to_markdown(overall_coverage(reports)) + tables;
}

int calibrate(const CalibrateOptions& options) {
  check(options);
  use_tensor_threads(1);
  make_folder(options.out);
  Json reports = Json::array();
  for (const std::string& material : options.materials) {
    const StudySettings settings = study_of(options, material);
    const CalibrationStudy study(settings, options.threads, [] { use_tensor_threads(1); });
    OutcomeFile file(file_of(options, settings), study_text(settings), study.quantities());
    make_missing(study, options, file);
    reports.push_back(report_json(report_of(study.quantities(), file.outcomes()), study_text(settings)));
    write_file_atomically(options.out / "README.md", page_of(studies_in(options.out)));
  }
  options.json ? print(reports) : print(page_of(studies_in(options.out)));
  return kDone;
}

/// Of the posteriors and of their samples.
void add_study(CLI::App& command, CalibrateOptions& options) {
  command
      .add_option("--resolution", options.study.posterior.resolution,
                  "Pixels a side at which renders are compared with a photo")
      ->capture_default_str();
  command
      .add_option("--photo-pixels", options.study.camera.least_side,
                  "Pixels a side that a photo has at least, where a pixel is not its middle")
      ->capture_default_str();
  command
      .add_option("--summary", options.summary,
                  "What renders and photo are compared by (default: the material's)")
      ->type_name("NAME");
  command
      .add_option("--pilot", options.study.simulations.pilot,
                  "Photos of the prior that calibrated errors begin with where a material has no predictor")
      ->capture_default_str();
  command
      .add_option("--error-scale", options.study.error_scale,
                  "Times the sd that calibrated errors have: other than 1 to see that the table finds it out")
      ->capture_default_str();
  command.add_option("--chains", options.study.chains, "Chains a photo")->capture_default_str();
  command.add_option("--warmup", options.study.warmup, "Warm-up iterations of each chain")
      ->capture_default_str();
  command.add_option("--draws", options.study.draws, "Draws of each chain")->capture_default_str();
}

}  // namespace

void add_calibrate(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<CalibrateOptions>();
  options->materials = material_names();
  options->study.posterior.resolution = 64;
  options->study.errors = "calibrated";
  CLI::App& command = *app.add_subcommand(
      "calibrate", "How often intervals hold the truth, over synthetic photos of draws from the prior");
  command.add_option("--material", options->materials, "The material's name (repeatable; default: all)")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      .add_option("--out", options->out,
                  "Folder for a table a material and README.md; photos that it has are not made again")
      ->type_name("DIR")
      ->required();
  command
      .add_option("--errors", options->study.errors,
                  "Error model: paper (set by hand), averaged (over irregularities) or calibrated")
      ->check(CLI::IsMember(error_names()))
      ->capture_default_str();
  command.add_option("--photos", options->photos, "Number of synthetic photos")->capture_default_str();
  add_study(command, *options);
  command.add_option("--seed", options->study.seed, "Seed of everything drawn")
      ->capture_default_str()
      ->check(seed_problem);
  command.add_option("--threads", options->threads, "Photos at a time")->capture_default_str();
  command.add_flag("--json", options->json, "Print the report as one JSON document");
  command.add_flag("--quiet", options->quiet, "Print nothing but the report and errors");
  command.callback([options, &chosen] { chosen = [options] { return calibrate(*options); }; });
}

}  // namespace patina
