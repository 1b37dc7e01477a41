#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/sampling/warmup.h"

namespace patina {

/// Where chains meet at the end of a warm-up window to pool what they saw into one metric and one step size.
/// The result does not depend on who comes when.
class WarmupMeeting {
 public:
  /// @param metric  that the chains start with
  WarmupMeeting(int chains, std::shared_ptr<const Metric> metric)
      : reports_(static_cast<std::size_t>(chains)) {
    settings_.metric = std::move(metric);
  }

  /// Waits for all chains, at the end of the same window. @return what all go on with: pooled() of their
  /// reports
  /// @throws RunStopped if the run is stopped meanwhile
  KernelSettings meet(int chain, WindowReport report, bool adapts_metric, const std::stop_token& stop);

 private:
  std::mutex mutex_;
  std::condition_variable_any complete_;
  std::vector<WindowReport> reports_;
  int arrived_ = 0;
  int meetings_ = 0;
  KernelSettings settings_;
};

}  // namespace patina
