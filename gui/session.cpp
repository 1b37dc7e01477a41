#include "gui/session.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/comparison/ranking_json.h"
#include "engine/error.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr const char* kRunPhoto = "photo.png";  // a run directory's own copy

/// The geometry of a photo of which the width is known: with the camera's own field of view, if EXIF told.
Capture capture_of(const Photo& photo, double size_cm) {
  const Capture standard;
  const double camera =
      photo.focal_pixels ? *photo.focal_pixels / photo.crop.side : standard.camera_cm / standard.size_cm;
  return {size_cm, camera * size_cm};
}

}  // namespace

Session::Session(RunFactory factory, std::filesystem::path runs, std::function<void()> wake)
    : factory_(std::move(factory)),
      runs_(std::move(runs)),
      wake_(std::move(wake)),
      finder_(factory_.rank, wake_) {}

Session::~Session() = default;

void Session::open(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    open_run(run_opener()(path));
  } else {
    open_photo(load_photo(path, {std::nullopt, kWholeSide}), path);
  }
}

std::string Session::photo_name() const {
  const bool of_run = photo_file_.filename() == kRunPhoto;
  return of_run ? photo_name_of(photo_file_.parent_path()) : photo_file_.stem().string();
}

void Session::open_photo(Photo photo, const std::filesystem::path& file) {
  let_run_go();
  choices_.begin_photo(capture_of(photo, settings().capture.size_cm));
  photo_ = std::move(photo);
  photo_file_ = file;
  another_photo();
  if (!choices_.material_is_chosen()) look_for_material(false);
}

void Session::recrop(Photo photo) {
  const bool looking = finder_.busy();
  photo_ = std::move(photo);
  another_photo();
  if (looking) look_for_material(asked_.asked_for);
}

void Session::another_photo() {
  ++photo_version_;
  finder_.cancel();
}

void Session::look_for_material(bool asked_for) {
  assert(has_photo() && photo_is_current());
  const RankSettings asked = first_cut(settings(), settings().capture);
  asked_ = {{}, photo_version_, asked.capture, asked_for};
  finder_.start(std::make_shared<const Image>(photo_->image), asked);
}

void Session::take_in_ranking() {
  auto ranking = finder_.take();
  if (!ranking || ranking->materials.empty()) return;
  asked_.ranking = std::move(*ranking);
  hint_ = asked_;
  ++hint_version_;
  const bool has_begun = has_run() || choices_.can_undo();
  if (hint_->asked_for || !has_begun) choices_.suggest_material(hint_->ranking.materials.front().material);
}

const MaterialRanking* Session::hint() const {
  const bool of_this =
      hint_ && hint_->photo_version == photo_version_ && hint_->capture == settings().capture;
  return of_this ? &hint_->ranking : nullptr;
}

PhotoCrop Session::chosen_crop() const {
  return choices_.crop().value_or(central_crop(photo_->original_width, photo_->original_height));
}

void Session::crop_to(const PhotoCrop& crop) {
  Capture capture = settings().capture;
  capture.size_cm *= static_cast<double>(crop.side) / chosen_crop().side;
  choices_.set_crop(crop, capture);
}

bool Session::choices_wait() const {
  const bool other_crop = source_ && run_crop_ && *run_crop_ != chosen_crop();
  return source_ && (other_crop || choices_.differ_from(source_->settings()));
}

std::function<std::unique_ptr<DrawSource>(const std::filesystem::path& directory)> Session::run_opener()
    const {
  return [open = factory_.open, wake = wake_](const std::filesystem::path& directory) {
    return open(directory, wake);
  };
}

void Session::open_run(std::unique_ptr<DrawSource> source) {
  const std::filesystem::path directory = source->directory();
  RunChoices choices(source->settings());
  Photo photo;
  photo.image = source->photo();
  photo.original_width = photo.image.width;
  photo.original_height = photo.image.height;
  photo.crop = central_crop(photo.original_width, photo.original_height);

  adopt(std::move(source));
  run_crop_ = photo.crop;
  photo_ = std::move(photo);
  photo_file_ = std::filesystem::absolute(directory / kRunPhoto).lexically_normal();
  another_photo();
  choices_ = std::move(choices);
}

void Session::start() { start(settings()); }

void Session::start_at(const ParameterValues& values) { start(choices_.started_at(values)); }

void Session::hold_and_go_on(const std::map<std::string, double>& values) {
  assert(run_is_of_choice());
  const auto best = model_.best();
  const bool searched = status_.best && !(best && model_.draws().lp(*best) > status_.best_lp);
  choices_.hold(values);
  if (searched)
    start_at(*status_.best);
  else if (best)
    start_at(model_.draws().values(*best));
  else
    start();
}

void Session::start(const RunSettings& settings) {
  if (!photo_) throw UserError("There is no photo yet: drop one on the window, or open one.");
  if (!photo_is_current())
    throw UserError("The part of the photo that you chose is still being read: start again in a moment.");
  // A run directory's own copy is a photo like any other; only its file tells the checksum.
  if (photo_->sha256.empty()) photo_ = load_photo(photo_file_);
  adopt(
      factory_.start(settings, *photo_, fresh_run_directory(runs_, photo_name(), settings.material), wake_));
  run_crop_ = photo_->crop;
  begun_ = std::chrono::steady_clock::now();
  keep_hint();
}

void Session::keep_hint() const {
  if (hint() == nullptr) return;
  try {
    write_ranking(source_->directory(), *hint());
  } catch (const UserError&) {
    // The run has begun, and no draw depends on it.
  }
}

std::optional<double> Session::seconds_spent() const {
  if (!begun_) return std::nullopt;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - *begun_).count();
}

void Session::let_run_go() {
  summary_worker_.reset();
  if (source_) {
    leaving_ = std::async(std::launch::async,
                          [old = std::shared_ptr<DrawSource>(std::move(source_))]() mutable { old.reset(); });
  }
  model_ = ExplorerModel();
  kept_stars_.clear();
  status_ = RunStatus();
  summary_.reset();
  advice_.clear();
  run_crop_.reset();
  begun_.reset();
  readable_ = true;
  ++run_version_;
}

void Session::adopt(std::unique_ptr<DrawSource> source) {
  let_run_go();
  source_ = std::move(source);
  model_ = ExplorerModel(source_->table());
  summary_worker_ = std::make_unique<SummaryWorker>(source_->table(), wake_);
  status_ = source_->status();
  load_stars();
}

void Session::load_stars() {
  try {
    kept_stars_ = read_stars(source_->directory());
    model_.set_stars(kept_stars_);
  } catch (const UserError& error) {
    stars_problem_ = error.what();
  }
}

void Session::save_stars() {
  if (!stars_problem_.empty()) throw UserError(std::exchange(stars_problem_, {}));
  if (!source_ || model_.stars() == kept_stars_) return;
  kept_stars_ = model_.stars();  // also where it fails: the same words every frame help nobody
  write_stars(source_->directory(), kept_stars_);
}

void Session::pause() {
  if (source_) source_->pause();
}

void Session::resume() {
  if (source_) source_->resume();
}

void Session::stop() {
  if (source_) source_->stop();
}

bool Session::can_go_on() const {
  const bool ended = status_.phase == RunPhase::finished || status_.phase == RunPhase::stopped;
  return source_ && ended && status_.read_fraction == 1 && !source_->settings().map_only;
}

void Session::go_on() {
  assert(can_go_on());
  RunSettings settings = source_->settings();
  const int warmup = in_force(settings, status_).warmup.value();
  const bool some_left = std::ranges::any_of(
      status_.chains, [&](const ChainStatus& chain) { return chain.iteration < warmup + settings.draws; });
  if (!some_left && !status_.chains.empty()) settings.draws *= 2;
  settings.stop.ess = settings.stop.rhat = 0;
  const std::optional<PhotoCrop> crop = run_crop_;
  auto resumed = factory_.resume(settings, source_->directory(), wake_);
  const ExplorerModel earlier = std::move(model_);
  adopt(std::move(resumed));
  run_crop_ = crop;
  begun_ = std::chrono::steady_clock::now();
  model_.take_over(earlier);
}

void Session::poll() {
  take_in_ranking();
  if (!source_ || !readable_) return;
  try {
    std::vector<Draw> draws = source_->take_draws();
    status_ = source_->status();
    model_.append(draws);
    summary_worker_->add(std::move(draws));
  } catch (...) {
    readable_ = false;
    throw;
  }
  if (auto live = summary_worker_->take()) {
    summary_ = std::move(live->summary);
    advice_ = std::move(live->advice);
  }
}

bool Session::is_live() const { return source_ && readable_ && !is_over(status_.phase); }

}  // namespace patina
