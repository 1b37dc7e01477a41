#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <stop_token>
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
/// ends it after the part that is being made.
class ExportWorker {
 public:
  struct Outcome {
    std::filesystem::path folder;
    bool cancelled = false;  ///< on the way: the folder holds what was done before
    std::string error;       ///< one sentence; empty: the folder holds the files
  };

  /// @param wake  called from the thread when there is news; may be empty
  explicit ExportWorker(std::function<void()> wake = {}) : wake_(std::move(wake)) {}
  ~ExportWorker() { cancel(); }

  bool busy() const { return pending_.valid(); }
  void start(std::vector<ExportJob> jobs, const std::filesystem::path& folder);  ///< not while busy()
  double done() const { return done_; }                                          ///< of all jobs, 0 to 1
  void cancel() { stop_.request_stop(); }  ///< asks; how far it came take() tells
  std::optional<Outcome> take();           ///< how the export ended, once; to be asked again while busy()

 private:
  Outcome write(const std::vector<ExportJob>& jobs, const std::filesystem::path& folder,
                const std::stop_token& stop);

  std::function<void()> wake_;
  std::stop_source stop_;
  std::atomic<double> done_ = 0;
  std::future<Outcome> pending_;  // last: it is waited for before what it uses goes
};

}  // namespace patina
