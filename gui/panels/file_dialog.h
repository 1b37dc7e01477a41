#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gui/directory_listing.h"
#include "gui/panels/export_form.h"
#include "gui/panels/panel.h"

namespace patina {

/// A file browser inside the window: folders, runs and images by the mouse, any path by typing it.
class FileDialog {
 public:
  enum class Purpose { open, export_folder };

  /// Shows the dialog. @param typed what the path field holds at first
  void show(Purpose purpose, const std::filesystem::path& folder, std::string typed);
  bool visible() const { return visible_; }
  void close() { visible_ = false; }
  Purpose purpose() const { return purpose_; }
  const std::filesystem::path& folder() const { return folder_; }  ///< the one last looked at
  void start_in(const std::filesystem::path& folder) { folder_ = folder; }

  /// Draws it if visible, with the form below the folders where it asks for one to export to.
  /// @return the path that was chosen, once: a photo or a run; or the folder to export to
  std::optional<std::filesystem::path> draw(const PanelContext& context, ExportForm& form);

 private:
  void enter(const std::filesystem::path& folder);
  void draw_path();
  void draw_entries(float below);
  void draw_buttons();
  void accept_typed();
  void accept(const DirectoryEntry& entry);

  Purpose purpose_ = Purpose::open;
  bool visible_ = false;
  bool focus_path_ = false;
  std::filesystem::path folder_;
  std::vector<DirectoryEntry> entries_;
  std::string typed_;
  std::string problem_;
  std::optional<std::filesystem::path> chosen_;
};

}  // namespace patina
