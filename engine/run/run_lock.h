#pragma once

#include <filesystem>

namespace patina {

/// Held by the process that writes a run directory for as long as it writes. The system drops it when the
/// process ends, however it ends; the file goes with the holder. Where the file system has no locks, the run
/// merely looks finished to others.
class RunLock {
 public:
  /// @throws UserError if the file cannot be made, or another writer holds it
  explicit RunLock(const std::filesystem::path& file);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

/// Whether some writer, in any process, holds the lock.
bool is_locked(const std::filesystem::path& file);

}  // namespace patina
