#pragma once

#include <Eigen/Core>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/sampling/metric.h"

namespace patina {

/// Where chains meet at the end of a warm-up window to pool what they saw into one metric. The result does
/// not depend on who comes when.
class WarmupMeeting {
 public:
  explicit WarmupMeeting(int chains) : positions_(static_cast<std::size_t>(chains)) {}

  /// Waits for all chains. @param positions  of this chain's window (dimension x transitions)
  /// @return the metric that all chains go on with
  /// @throws RunStopped if the run is stopped meanwhile
  std::shared_ptr<const Metric> meet(int chain, Eigen::MatrixXd positions, const std::stop_token& stop);

 private:
  std::mutex mutex_;
  std::condition_variable_any complete_;
  std::vector<Eigen::MatrixXd> positions_;
  int arrived_ = 0;
  int meetings_ = 0;
  std::shared_ptr<const Metric> metric_;
};

}  // namespace patina
