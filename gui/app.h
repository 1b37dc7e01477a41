#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/waker.h"
#include "gui/action.h"
#include "gui/background_loader.h"
#include "gui/export_worker.h"
#include "gui/history.h"
#include "gui/keyboard_focus.h"
#include "gui/panels/command_palette.h"
#include "gui/panels/cost_panel.h"
#include "gui/panels/error_banner.h"
#include "gui/panels/export_form.h"
#include "gui/panels/file_choice.h"
#include "gui/panels/file_dialog.h"
#include "gui/panels/material_panel.h"
#include "gui/panels/photo_panel.h"
#include "gui/panels/preview_panel.h"
#include "gui/panels/scatter_panel.h"
#include "gui/preview/preview_feed.h"
#include "gui/session.h"
#include "gui/step_order.h"
#include "gui/view_choices.h"
#include "gui/window/fonts.h"
#include "gui/window/layout.h"
#include "gui/window/preferences.h"
#include "gui/window/window.h"

namespace patina {

/// The desktop program: one window, one session, the panels between them. Whatever a user can mend becomes a
/// sentence in the window, and the program goes on.
class App {
 public:
  /// @param window       outlives the app
  /// @param runs         folder for the directories of runs started here
  /// @param preferences  file that remembers how the program was left; empty: nothing is remembered
  App(Window& window, RunFactory factory, const std::filesystem::path& runs,
      const std::filesystem::path& preferences = {});
  ~App();

  /// Opens a photo or a run. @throws UserError; everything is as it was before then
  void load(const std::filesystem::path& path);
  /// As load(), but a photo is read while frames go on; what is wrong becomes a sentence in the window.
  void open(const std::filesystem::path& path);
  /// As open(), and starts a run on a photo as soon as it is there and its material was looked for.
  void open_and_start(const std::filesystem::path& path);
  /// Starts a run on the photo that is open, likewise.
  void start_when_ready() { starts_when_ready_ = true; }
  /// Opens the run that was open when the program was left, at the same draw. @return whether there is one
  bool reopen();

  /// Waits until something happens, at most so many seconds, then draws one frame.
  void frame(double longest_wait = 3600);

  Session& session() { return session_; }
  const Session& session() const { return session_; }
  const std::vector<Action>& actions() const { return actions_; }
  const ErrorBanner& banner() const { return banner_; }
  const ScatterPanel& scatter() const { return scatter_; }
  PreviewPanel& preview() { return preview_; }
  const PreviewPanel& preview() const { return preview_; }
  const MaterialPanel& material() const { return material_; }
  const FileDialog& dialog() const { return dialog_; }
  bool previews_waiting() const { return previews_.waiting(); }
  PhotoPanel& photo_panel() { return photo_; }
  const FileChoice& file_choice() const { return file_choice_; }
  const CommandPalette& palette() const { return palette_; }
  const CostPanel& costs() const { return costs_; }
  const Preferences& preferences() const { return preferences_; }
  bool loading() const { return photo_loader_.busy() || run_loader_.busy(); }
  bool exporting() const { return exporter_.busy(); }

 private:
  /// What has a history.
  enum class Choices { draws, next_run, view };
  struct PhotoRequest {
    std::filesystem::path file;
    std::optional<PhotoCrop> crop;
    bool operator==(const PhotoRequest&) const = default;
  };

  double patience() const;  ///< seconds until something may change by itself
  void attempt(const std::function<void()>& action);
  std::vector<Action> make_actions();
  std::vector<Action> file_actions();
  std::vector<Action> view_actions();
  std::vector<Action> recent_actions();
  std::vector<Action> run_actions();
  std::vector<Action> material_actions();
  std::vector<Action> preview_actions();
  std::vector<Action> draw_actions();
  std::vector<Action> plot_actions();
  void remember();
  void save_preferences();
  void take_in_news();
  void finish_loading();
  void finish_loading_photo();
  void finish_loading_run();
  void start_if_ready();
  void follow_crop();
  void announce_opened();
  void take_dropped_files();
  void paste_path();
  void finish_export();
  void handle_keys();
  void handle_escape();
  void give_keys_to_plot(bool given);
  void give_keys_to_photo(bool given);
  void draw_panels();
  void undo();
  void redo();
  ViewChoices view_choices() const;
  bool restore_view();
  void note_steps();
  void draw_dialogs(const PanelContext& context);
  void ask_to_open();
  void ask_to_export();
  void ask_to_export_draw(std::size_t draw);
  void ask_to_export_starred();
  void ask_for_export_folder(std::vector<ExportJob> jobs, const std::string& name);
  void start_export(const std::filesystem::path& folder);
  void star_shown();

  Window& window_;
  std::filesystem::path preferences_file_;
  ErrorBanner banner_;
  Preferences preferences_, saved_preferences_;
  std::chrono::steady_clock::time_point saved_at_;
  Fonts fonts_{};
  bool dressed_ = false;  ///< fonts and colours are as the preferences want them
  Waker draw_news_;
  Session session_;
  PreviewFeed previews_;
  ExportWorker exporter_;
  BackgroundLoader<PhotoRequest, Photo> photo_loader_;
  BackgroundLoader<std::filesystem::path, std::unique_ptr<DrawSource>> run_loader_;
  bool starts_when_ready_ = false;
  FileDialog dialog_;
  FileChoice file_choice_;
  CommandPalette palette_;
  CostPanel costs_;
  PhotoPanel photo_;
  PreviewPanel preview_;
  ScatterPanel scatter_;
  MaterialPanel material_;
  ExportForm export_form_;
  Commands commands_;
  History<ExplorerChoices> history_{ExplorerChoices()};  ///< of what the user chose about the run's draws
  int history_run_ = 0;
  std::optional<History<ViewChoices>> view_history_;  ///< from the first frame on
  std::chrono::steady_clock::time_point wheeled_at_;
  StepOrder<Choices> steps_;
  std::vector<ExportJob> export_jobs_;  ///< what the export dialog is open for
  std::string export_note_;
  bool help_open_ = false;
  KeyboardFocus keyboard_;
  std::vector<Action> actions_;
};

}  // namespace patina
