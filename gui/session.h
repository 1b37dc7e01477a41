#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/io/photo.h"
#include "engine/run/draw_source.h"
#include "gui/explorer_model.h"
#include "gui/material_finder.h"
#include "gui/run_choices.h"
#include "gui/run_factory.h"
#include "gui/summary_worker.h"

namespace patina {

/// What is open in the window: a photo, the settings of the next run, and the run with all that came of it.
/// No ImGui, no GL; used from the window's thread. Where a function throws, everything is as it was before.
class Session {
 public:
  static constexpr int kWholeSide = 1024;  ///< pixels of the longer side of a photo that is shown whole

  /// @param runs  folder in which start() makes run directories
  /// @param wake  called from other threads when poll() would find something new
  Session(RunFactory factory, std::filesystem::path runs, std::function<void()> wake);
  ~Session();

  /// Opens a photo, or a run directory to look at. The run that was open is let go (a sampler stops).
  /// @throws UserError
  void open(const std::filesystem::path& path);

  /// Opens a photo that was read, or a run of which the directory was, in place of all that is open. While
  /// nobody has chosen a material, that of a photo is looked for.
  void open_photo(Photo photo, const std::filesystem::path& file);
  void open_run(std::unique_ptr<DrawSource> run);
  /// What opens a run directory for open_run(), from any thread. @throws UserError
  std::function<std::unique_ptr<DrawSource>(const std::filesystem::path& directory)> run_opener() const;
  /// Takes in another part of the photo that is open; the run stays.
  void recrop(Photo photo);

  bool has_photo() const { return photo_.has_value(); }
  const Photo& photo() const { return *photo_; }
  std::string photo_name() const;  ///< the file's name without extension; of a run see photo_name_of()
  const std::filesystem::path& photo_file() const { return photo_file_; }
  int photo_version() const { return photo_version_; }  ///< grows with every photo

  /// Chooses another part of the photo. The camera stays where it was, so that the sample's width changes.
  void crop_to(const PhotoCrop& crop);
  /// Whether photo() is the part that is chosen; another one has to be read if not.
  bool photo_is_current() const { return !photo_ || photo_->crop == chosen_crop(); }
  PhotoCrop chosen_crop() const;  ///< there is a photo

  /// What the user has chosen for the next run.
  RunChoices& choices() { return choices_; }
  const RunChoices& choices() const { return choices_; }
  const RunSettings& settings() const { return choices_.settings(); }

  /// Begins to find out which material the photo shows, because the user asked; there is a photo, and it is
  /// current. Once that is known, the material is chosen, and hint() tells why.
  void find_material() { look_for_material(true); }
  MaterialFinder& finder() { return finder_; }
  /// How likely all materials are for this photo at its size; null: not looked for.
  const MaterialRanking* hint() const;
  int hint_version() const { return hint_version_; }  ///< grows with every one that was found
  bool hint_was_asked_for() const { return hint_ && hint_->asked_for; }

  /// Whether the run that is open does not infer what is chosen now: the choices wait for the next one.
  bool choices_wait() const;
  /// Whether the run that is open is of the material that is chosen.
  bool run_is_of_choice() const { return source_ && source_->settings().material == settings().material; }

  /// Starts a run on the photo in a fresh directory; the run that was open is let go.
  /// @throws UserError if there is no photo or the run cannot start
  void start();
  /// Likewise, every chain from these values of the chosen material, held to what is assumed of them now.
  void start_at(const ParameterValues& values);
  /// Holds what the open run's draws leave open, and starts anew at its best match.
  void hold_and_go_on(const std::map<std::string, double>& values);

  /// Closes the run that is open; its photo stays.
  void close_run() { let_run_go(); }

  bool has_run() const { return source_ != nullptr; }
  const DrawSource& run() const { return *source_; }
  int run_version() const { return run_version_; }  ///< grows with every run or photo opened
  void pause();
  void resume();
  void stop();
  /// Since the run was started or continued here; none for one that was read from its directory.
  std::optional<double> seconds_spent() const;

  /// Whether the run that is open ended, here or in another program, and can be gone on with.
  bool can_go_on() const;
  /// Draws on in the run that ended: for as long again if it ended before all its draws were made, else as
  /// many more as it had. Its goals of quality no longer end it. What the user chose about its draws stays,
  /// but for which are marked. @throws UserError
  void go_on();

  /// Takes in what arrived since the last call. @throws UserError once if the run directory became unreadable
  void poll();

  /// Whether the run must be polled even if nothing wakes the window (another process may be writing it).
  bool is_live() const;

  /// Keeps the model's stars in the run directory if they changed since the last call.
  /// @throws UserError if that fails, and once where those that were kept there cannot be read
  void save_stars();

  ExplorerModel& model() { return model_; }
  const ExplorerModel& model() const { return model_; }
  const RunStatus& status() const { return status_; }
  const std::optional<RunSummary>& summary() const { return summary_; }   ///< of the draws after warm-up
  const std::vector<ParameterAdvice>& advice() const { return advice_; }  ///< what these say of the next run

 private:
  void start(const RunSettings& settings);
  void let_run_go();
  void adopt(std::unique_ptr<DrawSource> source);
  void load_stars();
  void another_photo();
  void look_for_material(bool asked_for);
  void take_in_ranking();
  void keep_hint() const;  ///< with the run that was started

  RunFactory factory_;
  std::filesystem::path runs_;
  std::function<void()> wake_;
  std::optional<Photo> photo_;
  std::filesystem::path photo_file_;
  std::optional<PhotoCrop> run_crop_;  ///< the part of photo_ that the open run is of; none: of another photo
  std::optional<std::chrono::steady_clock::time_point>
      begun_;  ///< when the run was started or continued here
  RunChoices choices_;
  ExplorerModel model_;
  RunStatus status_;
  std::optional<RunSummary> summary_;
  std::vector<ParameterAdvice> advice_;
  /// A ranking, and what it was made of.
  struct Hint {
    MaterialRanking ranking;
    int photo_version = 0;
    Capture capture;
    bool asked_for = false;  ///< by the user; if not, it must not get in the way
  };
  std::optional<Hint> hint_;
  int hint_version_ = 0;
  Hint asked_;                    ///< what the finder looks at
  std::vector<Star> kept_stars_;  ///< as the run directory has them
  std::string stars_problem_;     ///< why they could not be read
  bool readable_ = true;
  int photo_version_ = 0;
  int run_version_ = 0;
  MaterialFinder finder_;
  std::future<void> leaving_;  ///< the end of the run before: a sampler may take an evaluation to stop
  std::unique_ptr<DrawSource> source_;
  std::unique_ptr<SummaryWorker> summary_worker_;
};

}  // namespace patina
