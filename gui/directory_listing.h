#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

/// What a folder offers to open. Hidden files and files that are no images are left out.
struct DirectoryEntry {
  enum class Kind { folder, run, image };
  Kind kind;
  std::string name;
};

/// Folders first, then runs (folders with a run.json), then images, each by name.
/// @throws UserError if the folder cannot be read
std::vector<DirectoryEntry> list_directory(const std::filesystem::path& folder);

/// Whether a file's extension is one of an image that may be opened.
bool looks_like_image(const std::filesystem::path& file);

/// Whether the folder is a run directory, as far as its name for the settings goes.
bool looks_like_run(const std::filesystem::path& folder);

/// A path as a user types or copies it: ~ is the home folder, relative paths start in `folder`; blanks, line
/// ends and quotes around it are dropped; a file:// address is its path.
std::filesystem::path typed_path(const std::string& text, const std::filesystem::path& folder);

}  // namespace patina
