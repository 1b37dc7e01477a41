#pragma once

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/sampling/warmup.h"

namespace patina {

/// Where chains meet at the end of a warm-up window to pool what they saw into one metric and one step
/// size. The result does
/// not depend on who comes when.
class WarmupMeeting {
 public:
  /// @param metric_worth  as pool() has it
  explicit WarmupMeeting(int chains, MetricKind kind = MetricKind::dense, double metric_worth = 0)
      : kind_(kind), metric_worth_(metric_worth), results_(static_cast<std::size_t>(chains)) {}

  /// Waits for all chains. @param result  of this chain's window
  /// @return the metric and the step size that all chains go on with: pool() of all results
  /// @throws RunStopped if the run is stopped meanwhile
  KernelSettings meet(int chain, WindowResult result, const std::stop_token& stop);

 private:
  MetricKind kind_;
  double metric_worth_;
  std::mutex mutex_;
  std::condition_variable_any complete_;
  std::vector<WindowResult> results_;
  int arrived_ = 0;
  int meetings_ = 0;
  KernelSettings pooled_;
};

}  // namespace patina
