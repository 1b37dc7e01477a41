#pragma once

#include <filesystem>

namespace patina {

/// A new folder among the system's temporary ones, removed with all that it holds when this goes.
class ScratchFolder {
 public:
  ScratchFolder();  ///< @throws UserError if none can be made
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace patina
