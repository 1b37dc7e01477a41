#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gui/export_worker.h"
#include "gui/fonts.h"
#include "gui/history.h"
#include "gui/layout.h"
#include "gui/panels/draw_panel.h"
#include "gui/panels/error_banner.h"
#include "gui/panels/file_dialog.h"
#include "gui/panels/material_panel.h"
#include "gui/panels/photo_panel.h"
#include "gui/panels/preview_panel.h"
#include "gui/panels/scatter_panel.h"
#include "gui/preview_feed.h"
#include "gui/session.h"
#include "gui/window.h"

namespace patina {

/// The desktop program: one window, one session, the panels between them. Whatever a user can mend becomes a
/// sentence in the window, and the program goes on.
class App {
 public:
  /// @param window  outlives the app
  /// @param runs    folder for the directories of runs started here
  App(Window& window, RunFactory factory, const std::filesystem::path& runs);

  /// Opens a photo or a run. @throws UserError; everything is as it was before then
  void load(const std::filesystem::path& path);

  /// Waits until something happens, at most so many seconds, then draws one frame.
  void frame(double longest_wait = 3600);

  Session& session() { return session_; }
  const Session& session() const { return session_; }
  const ErrorBanner& banner() const { return banner_; }
  const ScatterPanel& scatter() const { return scatter_; }
  const PreviewPanel& preview() const { return preview_; }
  const FileDialog& dialog() const { return dialog_; }
  bool exporting() const { return exporter_.busy(); }

 private:
  double patience() const;  ///< seconds until something may change by itself
  void attempt(const std::function<void()>& action);
  void take_in_news();
  void finish_export();
  void handle_keys();
  void handle_escape();
  void draw_panels();
  void undo();
  void redo();
  void note_step();
  void draw_dialogs(const PanelContext& context);
  void ask_to_open();
  void ask_to_export();
  void ask_to_export_draw(std::size_t draw);
  void ask_to_export_starred();
  void ask_for_export_folder(std::vector<ExportJob> jobs, const std::string& name);
  void start_export(const std::filesystem::path& folder);
  void star_shown();

  Window& window_;
  Fonts fonts_;
  Session session_;
  PreviewFeed previews_;
  ExportWorker exporter_;
  ColumnShares shares_;
  ErrorBanner banner_;
  FileDialog dialog_;
  PhotoPanel photo_;
  PreviewPanel preview_;
  ScatterPanel scatter_;
  MaterialPanel material_;
  DrawPanel draw_;
  Commands commands_;
  History<ExplorerChoices> history_{ExplorerChoices()};  ///< of what the user chose about the run's draws
  int history_run_ = 0;
  std::vector<ExportJob> export_jobs_;  ///< what the export dialog is open for
  std::string export_note_;
  bool help_open_ = false;
};

}  // namespace patina
