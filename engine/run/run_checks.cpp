#include "engine/run/run_checks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/run/chain_start.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/run_files.h"
#include "engine/sampling/kernels.h"
#include "engine/summary/device.h"
#include "engine/summary/precision.h"

namespace patina {
namespace {

void check_count(const char* what, int value, int low, int high) {
  if (value >= low && value <= high) return;
  throw UserError("The number of " + std::string(what) + " is " + std::to_string(value) +
                  ": choose one from " + std::to_string(low) + " to " + std::to_string(high) + ".");
}

void check_length(const char* what, double cm) {
  if (cm >= 0.1 && cm <= 10'000) return;
  throw UserError("The " + std::string(what) + " must be from 0.1 to 10000 cm.");
}

void check_name(const char* what, const std::string& name, const std::vector<std::string>& names) {
  if (std::ranges::find(names, name) != names.end()) return;
  std::string known;
  for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
  throw UserError("There is no " + std::string(what) + " '" + name + "': use " + known + ".");
}

}  // namespace

std::vector<std::string> error_names() { return {"paper", "averaged", "calibrated"}; }

std::vector<std::string> asked_error_names() {
  std::vector<std::string> names = error_names();
  names.insert(names.begin(), kAuto);
  return names;
}

void check_resolution(int resolution) {
  check_count("pixels a side (resolution)", resolution, kLeastResolution, kMostResolution);
}

void check_capture(const Capture& capture) {
  check_length("size of the sample", capture.size_cm);
  check_length("distance of the camera", capture.camera_cm);
}

void check_settings(const RunSettings& settings, const Photo& photo) {
  check_count("chains", settings.chains, 1, kMostChains);
  check_count("warm-up iterations", settings.warmup.value_or(0), 0, kMostIterations);
  check_count("draws", settings.draws, 1, kMostIterations);
  check_resolution(settings.resolution);
  check_capture(settings.capture);
  if (!(settings.alpha > 0 && settings.alpha <= 1))
    throw UserError("The share of continuous moves (alpha) must be above 0 and at most 1.");
  if (settings.refresh && !(*settings.refresh >= 0 && *settings.refresh < 1))
    throw UserError("The share of refresh moves must be at least 0 and below 1.");
  if (!(settings.stop.minutes >= 0 && settings.stop.ess >= 0))
    throw UserError("The minutes and the effective draws to stop at must be at least 0.");
  if (settings.stop.rhat != 0 && !(settings.stop.rhat > 1))
    throw UserError("The R-hat to stop at must be above 1, for example 1.01.");
  if (settings.temper != 0 && !(settings.temper >= 2 && settings.temper <= kMostRungs))
    throw UserError("The rungs from prior to posterior (temper) are " + std::to_string(settings.temper) +
                    ": choose from 2, the two themselves, to " + std::to_string(kMostRungs) +
                    ", or 0 for chains without a ladder.");
  if (!(settings.path_length > 0 && settings.path_length <= 100))
    throw UserError("The length of a path must be above 0 and at most 100 standard deviations.");
  check_name("error model", settings.errors, asked_error_names());
  check_name("precision", settings.precision, precision_names());
  check_name("device", settings.device, device_names());
  check_at_hand(device_named(settings.device));
  if (settings.precision == "bfloat16" && settings.device == "cpu" && !bfloat16_pays())
    throw UserError("bfloat16 is no faster than float32 on this processor: leave it at float32.");
  check_name("start", settings.start, start_names());
  check_name("kernel", settings.kernel, run_kernel_names());
  check_name("metric", settings.metric, metric_names());
  check_name("discrete proposal", settings.discrete, discrete_names());
  if (photo.image.empty() || photo.image.width != photo.image.height || photo.image.channels != 3)
    throw UserError("The photo is not a square of three channels: open it again.");
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw UserError("Cannot make the folder " + folder.string() + " (" + error.message() +
                    "): choose another place.");
}

void check_holds_no_run(const std::filesystem::path& directory) {
  std::error_code ignored;
  if (std::filesystem::exists(manifest_file(directory), ignored) ||
      std::filesystem::exists(chain_file(directory, 0), ignored))
    throw UserError(directory.string() + " holds a run already: choose another directory.");
}

}  // namespace patina
