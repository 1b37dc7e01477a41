#pragma once

#include <optional>
#include <string>
#include <thread>

#include "engine/run/run_shared.h"
#include "engine/run/stop_monitor.h"

namespace patina {

/// Stops a run when one of its stop rules says so, from a thread of its own.
class StopWatcher {
 public:
  /// Time counts from here. @param shared  of the run; outlives this
  StopWatcher(const RunSettings& settings, const ParameterTable& table,
              const std::filesystem::path& directory, RunShared& shared);

  struct Verdict {
    std::string rule;  ///< the one that stopped the run, as a clause; empty: none
    /// Where the rules ask for quality: of the draws that reached it, else of all.
    std::optional<StopEvidence> evidence;
  };

  /// Ends the watch. Once.
  Verdict end() noexcept;

 private:
  void watch(const std::stop_token& stop) noexcept;

  StopRules rules_;
  RunShared& shared_;
  std::optional<StopMonitor> monitor_;  ///< where the rules ask for quality; the thread's until it ends
  std::string rule_;                    ///< likewise
  std::jthread thread_;
};

}  // namespace patina
