#include "engine/run/sampler_run.h"

#include <deque>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/material/registry.h"
#include "engine/run/chain.h"
#include "engine/run/controlled_density.h"
#include "engine/run/first_line.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/network_checksum.h"
#include "engine/run/run_checks.h"
#include "engine/run/run_files.h"
#include "engine/run/threads.h"
#include "engine/run/version.h"
#include "engine/sampling/kernels.h"

namespace patina {
namespace {

Manifest first_manifest(const RunSettings& settings, const Photo& photo, const ParameterTable& table) {
  Manifest manifest;
  manifest.program = program_version();
  manifest.settings = settings;
  manifest.table = table;
  manifest.photo_sha256 = photo.sha256;
  manifest.photo_width = photo.original_width;
  manifest.photo_height = photo.original_height;
  manifest.photo_warnings = photo.warnings;
  manifest.network_sha256 = network_checksum(settings.network);
  const PosteriorSettings posterior;
  manifest.gram_sigma = posterior.gram_sigma;
  manifest.mean_sigma = posterior.mean_sigma;
  manifest.phase = RunPhase::searching;
  return manifest;
}

PosteriorSettings posterior_settings(const RunSettings& settings, int resolution) {
  PosteriorSettings posterior;
  posterior.material = settings.material;
  posterior.capture = settings.capture;
  posterior.resolution = resolution;
  posterior.summary = settings.summary;
  posterior.network = settings.network;
  posterior.z_seed = settings.z_seed;
  posterior.fixed = settings.fixed;
  posterior.priors = settings.priors;
  return posterior;
}

void check_free_parameters(const Posterior& posterior) {
  if (posterior.dimension() == 0)
    throw UserError("Every continuous parameter is held fixed: leave at least one free to be inferred.");
}

}  // namespace

SamplerRun::SamplerRun(const RunSettings& settings, const Photo& photo,
                       const std::filesystem::path& directory, std::function<void()> wake)
    : directory_(directory), settings_(settings), photo_(photo.image), shared_(std::move(wake)) {
  check_settings(settings_, photo);
  if (settings_.summary.empty()) settings_.summary = material_table(settings_.material).summary;
  check_holds_no_run(directory_);
  // The coarsest posterior costs little and refuses every unknown name, prior and network.
  posteriors_.push_back(std::make_unique<Posterior>(
      posterior_settings(settings_, pyramid(settings_.resolution).front()), photo_));
  check_free_parameters(*posteriors_.front());
  table_ = posteriors_.front()->table();
  manifest_ = first_manifest(settings_, photo, table_);

  make_folder(directory_);
  lock_ = std::make_unique<RunLock>(lock_file(directory_));
  write_image(photo_file(directory_), photo_, PixelDepth::u16);
  write_manifest();
  shared_.edit_status([&](RunStatus& status) {
    status.message = "getting ready";
    status.chains.resize(static_cast<std::size_t>(settings_.chains));
  });
  coordinator_ = std::thread([this] { coordinate(); });
}

SamplerRun::~SamplerRun() {
  shared_.control.stop();
  coordinator_.join();
}

RunStatus SamplerRun::status() const {
  RunStatus status = shared_.newest_status();
  if (has_ended(status.phase)) return status;
  if (const auto reason = shared_.control.pause_reason()) {
    status.phase = RunPhase::paused;
    status.message = *reason;
  } else {
    status.draws_per_second = shared_.draw_rate.per_second(RateMeter::Clock::now());
  }
  return status;
}

void SamplerRun::pause() {
  shared_.control.pause("paused");
  shared_.waker.note();
}

void SamplerRun::resume() {
  shared_.control.resume();
  shared_.waker.note();
}

void SamplerRun::stop() { shared_.control.stop(); }

void SamplerRun::write_manifest() { write_file_atomically(manifest_file(directory_), to_json(manifest_)); }

void SamplerRun::coordinate() noexcept {
  try {
    yield_to_the_window();
    run_to_the_end();
    conclude(RunPhase::finished, "finished: " + outcome());
  } catch (const RunStopped&) {
    const std::string failure = shared_.failure();
    if (failure.empty())
      conclude(RunPhase::stopped, "stopped: " + outcome());
    else
      conclude(RunPhase::failed, failure);
  } catch (const std::exception& error) {
    conclude(RunPhase::failed, first_line(error.what()));
  }
}

void SamplerRun::run_to_the_end() {
  const ModeFound found = search();
  manifest_.map =
      MapPoint{posteriors_.back()->values(found.mode.position), found.mode.evaluation.log_density};
  manifest_.phase = RunPhase::sampling;
  shared_.write_or_pause([&] { write_manifest(); });
  if (!settings_.map_only) sample(found);
}

void SamplerRun::enter(RunPhase phase, const std::string& message) {
  shared_.edit_status([&](RunStatus& status) {
    status.phase = phase;
    status.message = message;
  });
}

ModeFound SamplerRun::search() {
  use_tensor_threads(hardware_threads());
  enter(RunPhase::searching, "looking for a good match");
  const std::vector<int> levels = pyramid(settings_.resolution);
  for (std::size_t i = posteriors_.size(); i < levels.size(); ++i) {
    shared_.control.checkpoint();
    posteriors_.push_back(std::make_unique<Posterior>(posterior_settings(settings_, levels[i]), photo_));
  }
  ModeFound found = find_mode(posteriors_, settings_, shared_);
  posteriors_.erase(posteriors_.begin(), posteriors_.end() - 1);  // only the finest is sampled
  return found;
}

void SamplerRun::sample(const ModeFound& found) {
  enter(RunPhase::warming_up, "warming up");
  const Posterior& posterior = *posteriors_.back();
  const ControlledDensity target(posterior, shared_.control);
  const auto kernel =
      make_kernel(settings_.kernel, target, settings_.alpha, settings_.refresh, settings_.discrete);
  const ChainPlan plan{settings_,
                       table_,
                       target,
                       *kernel,
                       [&](const Position& position) { return posterior.values(position); },
                       found.mode,
                       found.laplace,
                       directory_};
  // Laplace's metric weighs as much as ten transitions a dimension, with which a covariance begins to be
  // known.
  const double laplace_worth = 10.0 * static_cast<double>(target.dimension());
  WarmupMeeting meeting(settings_.chains, metric_kind(settings_.metric), laplace_worth);
  std::deque<Chain> chains;  // their addresses stay
  for (int k = 0; k < settings_.chains; ++k)
    shared_.write_or_pause([&] { chains.emplace_back(plan, meeting, shared_, k); });
  {
    std::vector<std::jthread> threads;
    for (Chain& chain : chains) threads.emplace_back([&chain] { chain.run(); });
  }
  for (const Chain& chain : chains) draws_made_ += chain.draws_after_warmup();
  // A stop that came after the last draw changes nothing.
  const bool complete = draws_made_ == std::int64_t{settings_.chains} * settings_.draws;
  if (!complete || !shared_.failure().empty()) throw RunStopped();
}

void SamplerRun::conclude(RunPhase phase, const std::string& reason) {
  manifest_.phase = phase;
  manifest_.reason = reason;
  try {
    shared_.write_or_pause([&] { write_manifest(); });
  } catch (const RunStopped&) {
    // The disk is full and the run is over: without its last words the run looks stopped, which it is.
  }
  lock_.reset();
  enter(phase, reason);
}

std::string SamplerRun::outcome() const {
  if (draws_made_ > 0) return std::to_string(draws_made_) + " draws";
  if (!manifest_.map) return "no match was found yet";
  return settings_.map_only ? "the best match was found"
                            : "the best match was found, but there are no draws after warm-up";
}

}  // namespace patina
