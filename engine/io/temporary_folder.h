#pragma once

#include <filesystem>

namespace patina {

/// A new folder among the system's temporary ones, removed with all that it holds when this goes.
class TemporaryFolder {
 public:
  TemporaryFolder();  ///< @throws UserError if none can be made
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace patina
