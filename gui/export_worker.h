#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/export_draw.h"

namespace patina {

/// A draw to write, and the folder for it inside the one that the user chose; empty: that one itself.
struct ExportJob {
  ExportRequest request;
  std::string subfolder;
};

/// Writes draws to folders on a thread of its own, so that frames go on. One export at a time; the destructor
/// waits for it.
class ExportWorker {
 public:
  struct Outcome {
    std::filesystem::path folder;
    std::string error;  ///< one sentence; empty: the folder holds the files
  };

  bool busy() const { return pending_.valid(); }
  void start(std::vector<ExportJob> jobs, const std::filesystem::path& folder);  ///< not while busy()
  std::optional<Outcome> take();  ///< how the export ended, once; to be asked again while busy()

 private:
  std::future<Outcome> pending_;
};

}  // namespace patina
