#include "gui/panels/file_dialog.h"

#include <imgui_stdlib.h>

#include <utility>

#include "engine/error.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

namespace fs = std::filesystem;
constexpr const char* kFileDialog = "Files##dialog";

const char* kind_text(DirectoryEntry::Kind kind) {
  switch (kind) {
    case DirectoryEntry::Kind::folder:
      return "folder";
    case DirectoryEntry::Kind::run:
      return "run";
    case DirectoryEntry::Kind::image:
      return "photo";
  }
  return "";
}

}  // namespace

void FileDialog::show(Purpose purpose, const fs::path& folder, std::string typed) {
  purpose_ = purpose;
  visible_ = focus_path_ = true;
  chosen_.reset();
  enter(folder);
  typed_ = std::move(typed);
}

void FileDialog::enter(const fs::path& folder) {
  try {
    std::vector<DirectoryEntry> entries = list_directory(folder);
    // A trailing slash would make parent_path() the folder itself.
    folder_ = folder.has_filename() ? folder : folder.parent_path();
    entries_ = std::move(entries);
    problem_.clear();
    if (purpose_ == Purpose::open) typed_.clear();
  } catch (const UserError& error) {
    problem_ = error.what();
  }
}

void FileDialog::accept_typed() {
  const fs::path path = typed_path(typed_, folder_);
  std::error_code ignored;
  if (purpose_ == Purpose::export_folder) {
    chosen_ = path;
  } else if (fs::is_directory(path, ignored) && !looks_like_run(path)) {
    enter(path);
  } else if (fs::exists(path, ignored)) {
    chosen_ = path;
  } else {
    problem_ = "There is no " + path.string() + "; check the spelling.";
  }
}

void FileDialog::accept(const DirectoryEntry& entry) {
  const bool opens = purpose_ == Purpose::open && entry.kind != DirectoryEntry::Kind::folder;
  if (opens) {
    chosen_ = folder_ / entry.name;
  } else if (entry.kind != DirectoryEntry::Kind::image) {
    enter(folder_ / entry.name);
  }
}

void FileDialog::draw_path() {
  elided_text(folder_.string(), ImGui::GetContentRegionAvail().x, theme::kMuted);
  if (ImGui::Button("Up")) enter(folder_.parent_path());
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (focus_path_) ImGui::SetKeyboardFocusHere();
  focus_path_ = false;
  const char* hint = purpose_ == Purpose::open ? "Type a path, or choose below"
                                               : "Folder to write into; it is made if need be";
  if (ImGui::InputTextWithHint("##path", hint, &typed_, ImGuiInputTextFlags_EnterReturnsTrue)) {
    accept_typed();
    focus_path_ = true;
  }
}

void FileDialog::draw_entries(float below) {
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::kWell);
  ImGui::BeginChild("entries", {0, -below}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleColor();
  if (entries_.empty()) muted_text("No folders and no images here.");
  std::optional<DirectoryEntry> accepted;
  for (const DirectoryEntry& entry : entries_) {
    const bool greyed = purpose_ == Purpose::export_folder && entry.kind == DirectoryEntry::Kind::image;
    ImGui::BeginDisabled(greyed);
    if (ImGui::Selectable(("##" + entry.name).c_str(), false)) accepted = entry;
    ImGui::SameLine(1.2f * em);
    ImGui::TextDisabled("%s", kind_text(entry.kind));
    ImGui::SameLine(6 * em);
    ImGui::TextUnformatted(entry.name.c_str());
    ImGui::EndDisabled();
  }
  ImGui::EndChild();
  if (accepted) accept(*accepted);  // after the loop: it replaces the entries
}

void FileDialog::draw_buttons() {
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kError);
  ImGui::TextUnformatted(problem_.c_str());
  ImGui::PopStyleColor();
  ImGui::SetCursorPosY(ImGui::GetContentRegionMax().y - ImGui::GetFrameHeight());
  if (ImGui::Button("Cancel")) visible_ = false;
  const char* go = purpose_ == Purpose::open ? "Open" : "Export here";
  align_right(button_width(go));
  if (primary_button(go)) accept_typed();
}

std::optional<fs::path> FileDialog::draw(const PanelContext& context, ExportForm& form) {
  if (!begin_box(kFileDialog, visible_, {44, 34})) return std::nullopt;
  heading_text(context, purpose_ == Purpose::open ? "Open a photo or a run" : "Export the draw");
  draw_path();
  const bool exports = purpose_ == Purpose::export_folder;
  draw_entries(2 * ImGui::GetFrameHeightWithSpacing() + (exports ? form.height() : 0));
  if (exports) form.draw();
  draw_buttons();
  if (chosen_) visible_ = false;
  if (!visible_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return std::exchange(chosen_, std::nullopt);
}

}  // namespace patina
