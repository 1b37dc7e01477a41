#include "engine/run/sampler_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/run/asked_start.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/first_line.h"
#include "engine/run/first_manifest.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/mode_state.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/predicted_start.h"
#include "engine/run/run_alarms.h"
#include "engine/run/run_chains.h"
#include "engine/run/run_checks.h"
#include "engine/run/run_files.h"
#include "engine/run/run_photo.h"
#include "engine/run/run_target.h"
#include "engine/run/same_run.h"
#include "engine/run/state_file.h"
#include "engine/run/stop_watcher.h"
#include "engine/run/stopwatch.h"
#include "engine/run/threads.h"
#include "engine/run/warmup_state.h"
#include "engine/sampling/kernels.h"

namespace patina {
namespace {

bool is_emulated(const ModeFound& found) { return found.emulator || found.average; }

int warmup_in_use(int asked, const ModeFound& found, const Posterior& posterior) {
  if (found.average) return std::min(asked, kAveragedWarmup);
  return found.emulator && !has_jagged(posterior) ? std::min(asked, kEmulatedWarmup) : asked;
}

}  // namespace

SamplerRun::SamplerRun(const RunSettings& settings, const Photo& photo,
                       const std::filesystem::path& directory, std::function<void()> wake, Opening opening)
    : directory_(directory), settings_(settings), photo_(as_kept(photo.image)), shared_(std::move(wake)) {
  check_settings(settings_, photo);
  if (settings_.summary.empty()) settings_.summary = material_table(settings_.material).summary;
  if (opening == Opening::fresh) check_holds_no_run(directory_);
  finder_.emplace(settings_, photo_, shared_, [this](const MapPoint& best) { keep(best); });
  const bool jagged = settings_.errors != "calibrated" && has_jagged(finder_->posterior());
  if (!settings_.refresh) settings_.refresh = usual_refresh(jagged);
  if (!settings_.warmup) settings_.warmup = usual_warmup(jagged && !finder_->emulates());
  table_ = finder_->posterior().table();
  start_values(table_, settings_);
  if (settings_.start == "predict") prediction_for(settings_.material, photo_, settings_.capture);
  manifest_ = first_manifest(settings_, photo, table_);
  run_key_ = run_key(manifest_);

  if (opening == Opening::fresh)
    begin();
  else
    take_up();
  write_manifest();
  shared_.edit_status([&](RunStatus& status) {
    status.message = "getting ready";
    status.chains.resize(static_cast<std::size_t>(settings_.chains));
  });
  coordinator_ = std::thread([this] { coordinate(); });
}

void SamplerRun::begin() {
  make_folder(directory_);
  lock_ = std::make_unique<RunLock>(lock_file(directory_));
  write_image(photo_file(directory_), photo_, PixelDepth::u16);
}

void SamplerRun::take_up() {
  lock_ = std::make_unique<RunLock>(lock_file(directory_));
  const Manifest made = read_manifest(directory_);
  check_same_run(directory_, made, manifest_);
  check_has_mode(directory_);
  const Posterior finest(posterior_settings(settings_, settings_.resolution), photo_);  // which it is of
  found_ = read_mode(directory_, run_key_, finest, settings_);
  record_ = read_warmup(directory_, run_key_, finest, settings_.rungs());
  manifest_.map = made.map;
  manifest_.so_far = made.so_far;
  manifest_.basins = made.basins;
  manifest_.seconds = made.seconds;
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
  std::optional<StopWatcher> watcher;
  RunPhase phase = RunPhase::finished;
  try {
    watcher.emplace(settings_, table_, directory_, shared_);
    run_to_the_end();
  } catch (const RunStopped&) {
    phase = RunPhase::stopped;
  } catch (const std::exception& error) {
    shared_.fail(error.what());
  }
  const auto [rule, evidence] = watcher ? watcher->end() : StopWatcher::Verdict();
  manifest_.evidence = evidence;
  if (const std::string failure = shared_.failure(); !failure.empty())
    conclude(RunPhase::failed, failure);
  else if (phase == RunPhase::stopped && rule.empty())
    conclude(phase, "stopped: " + outcome());
  else
    conclude(RunPhase::finished, (rule.empty() ? "finished: " : "finished, for " + rule + ": ") + outcome());
}

void SamplerRun::run_to_the_end() {
  ModeFound found = find_or_recall();
  manifest_.alarms = run_alarms(photo_, posterior(), found.mode.position, finer_render(found.mode.position),
                                settings_.fixed, manifest_.photo_fit);
  manifest_.kernel = kernel_in_use(settings_, is_emulated(found));
  manifest_.errors = found.errors ? "calibrated" : found.wider ? "averaged" : "paper";
  manifest_.warmup = warmup_in_use(*settings_.warmup, found, posterior());
  shared_.edit_status([&](RunStatus& status) {
    status.alarms = manifest_.alarms;
    status.errors = manifest_.errors;
    status.warmup = manifest_.warmup;
  });
  manifest_.phase = RunPhase::sampling;
  shared_.write_or_pause([&] { write_manifest(); });
  if (!settings_.map_only) sample(std::move(found));
}

Image SamplerRun::finer_render(const Position& position) const {
  constexpr int kFiner = 4, kMostPixels = 4096;
  const Renderer renderer(settings_.material, settings_.z_seed, settings_.capture);
  return renderer.render(posterior().values(position), std::min(kFiner * settings_.resolution, kMostPixels));
}

void SamplerRun::enter(RunPhase phase, const std::string& message) {
  shared_.edit_status([&](RunStatus& status) {
    status.phase = phase;
    status.message = message;
  });
}

ModeFound SamplerRun::find_or_recall() {
  use_tensor_threads(hardware_threads());
  if (found_) recall();
  const bool was_a_match_alone = found_ && finder_->averages() && !found_->wider;
  if (!found_ || was_a_match_alone) {
    const Stopwatch stopwatch(manifest_.seconds.search);
    enter(RunPhase::searching, "looking for a good match");
    found_ = found_ ? finder_->average_over(manifest_.basins) : finder_->find();
    manifest_.photo_fit = finder_->photo_fit();
    manifest_.basins = found_->basins;
    note_map(*found_);
    shared_.write_or_pause([&] { write_manifest(); });  // before the mode, with which the basins are recalled
    keep(*found_);
  }
  return with_proposals(std::move(*found_));
}

void SamplerRun::recall() {
  finder_->take_up(*found_);
  check_is_where_it_was();
  manifest_.photo_fit = finder_->photo_fit();
  note_map(*found_);
  if (manifest_.basins.empty()) manifest_.basins.push_back(*manifest_.map);
  shared_.edit_status([&](RunStatus& status) {
    status.search_fraction = 1;
    status.best = posterior().values(found_->mode.position);
    status.best_lp = found_->mode.evaluation.log_density;
  });
}

void SamplerRun::note_map(const ModeFound& found) {
  manifest_.map = MapPoint{posterior().values(found.mode.position), found.mode.evaluation.log_density};
}

void SamplerRun::keep(const ModeFound& found) {
  shared_.write_or_pause([&] { write_mode(directory_, run_key_, found, settings_); });
}

ModeFound SamplerRun::with_proposals(ModeFound found) {
  if (!finder_->emulates() || settings_.map_only || found.has_tried_to_emulate) return found;
  const Stopwatch stopwatch(manifest_.seconds.search);
  if (found.wider) {
    found.average = learn_average(*finder_->coarsest(), posterior().with(found.wider->of_the_photo()),
                                  finder_->irregularities(), found.mode.position, *found.laplace,
                                  manifest_.basins, settings_, shared_);
  } else {
    Emulation made = learnt_about(found);
    found.emulator = std::move(made.emulator);
    if (found.emulator) found.known = std::move(made.known);
  }
  found.has_tried_to_emulate = true;
  keep(found);
  return found;
}

Emulation SamplerRun::learnt_about(const ModeFound& found) {
  return learn_emulator(*finder_->coarsest(), posterior(), found.mode, *found.laplace, manifest_.basins,
                        settings_, shared_);
}

/// The draws that there are would be of one posterior, those to come of another.
void SamplerRun::check_is_where_it_was() const {
  constexpr double kRounding = 1e-2;  // of log densities on other threads or another machine
  const double was = found_->mode.evaluation.log_density;
  const double is = posterior().value(found_->mode.position).log_density;
  if (!(std::abs(is - was) <= kRounding * (1 + std::abs(was))))
    refuse_state(mode_state_file(directory_), "photo.png is not the photo that it was found with");
}

void SamplerRun::keep(const MapPoint& best) {
  constexpr auto kInterval = std::chrono::seconds(2);
  manifest_.so_far = best;
  const auto now = std::chrono::steady_clock::now();
  if (now < keep_next_) return;
  shared_.write_or_pause([&] { write_manifest(); });
  keep_next_ = now + kInterval;
}

RunSettings SamplerRun::as_drawn() const {
  RunSettings settings = settings_;
  settings.warmup = manifest_.warmup;
  return settings;
}

bool SamplerRun::learn_again(ModeFound& found) {
  if (!found.emulator || found.has_learnt_again || *settings_.warmup == 0) return false;
  const Stopwatch stopwatch(manifest_.seconds.search);
  if (!found.known) found.known = learnt_about(found).known;
  found.emulator = emulator_of_warmup(posterior(), *found.known, found.mode, *found.laplace, directory_,
                                      as_drawn(), shared_);
  found.known.reset();
  found.has_learnt_again = true;
  keep(found);
  return true;
}

void SamplerRun::sample(ModeFound found) {
  enter(RunPhase::warming_up, "warming up");
  const Posterior& posterior = this->posterior();
  const RunTarget target(posterior, found, settings_, shared_.control);
  const auto kernel = target.kernel();
  std::unique_ptr<const Kernel> again;  // of the draws, where warm-up taught anything
  const auto kernel_of_draws = [&]() -> const Kernel& {
    if (learn_again(found)) again = target.kernel();
    return again ? *again : *kernel;
  };
  const ChainPlan plan{.settings = as_drawn(),
                       .table = table_,
                       .target = target.density(),
                       .kernel = *kernel,
                       .values = [&](const Position& position) { return posterior.values(position); },
                       .mode = target.mode(),
                       .laplace = target.spread(),
                       .metric = metric_in_use(metric_kind(settings_.metric), is_emulated(found)),
                       .directory = directory_,
                       .run_key = run_key_,
                       .start = start_of(posterior, settings_, photo_),
                       .kernel_of_draws = kernel_of_draws};
  ChainsDone done = run_chains(plan, record_, shared_);
  draws_made_ = done.draws;
  manifest_.seconds.warmup = std::move(done.warmup);
  manifest_.seconds.sampling = std::move(done.sampling);
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
  if (draws_made_ > 0) {
    const bool rough = manifest_.photo_fit && manifest_.photo_fit->discrepancy > 0;
    return std::to_string(draws_made_) + " draws" +
           (manifest_.evidence ? "; " + in_words(settings_.stop, *manifest_.evidence) : "") +
           (rough
                ? "; no simulated photo is quite like this one, so intervals allow for what renders usually "
                  "miss photos by"
                : "");
  }
  if (!manifest_.map)
    return manifest_.so_far ? "the search for a match had not ended, the best that it met is kept"
                            : "no match was found yet";
  return settings_.map_only ? "the best match was found"
                            : "the best match was found, but there are no draws after warm-up";
}

}  // namespace patina
