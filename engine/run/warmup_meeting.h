#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <utility>
#include <vector>

#include "engine/sampling/ladder.h"

namespace patina {

/// What the chains agreed on at the ends of windows, by the windows' numbers.
using WarmupRecord = std::map<int, LadderSettings>;

/// Where chains meet at the end of a warm-up window to pool what they saw into one metric and one step
/// size for each rung, and one ladder. The result does not depend on who comes when. It is written down
/// before anyone goes on with it, so that chains that are taken up again from different sides of a meeting
/// all leave it with the same.
class WarmupMeeting {
 public:
  using Save = std::function<void(const WarmupRecord&)>;

  /// @param metric_worth, jagged  as pool() has them
  /// @param save     called with the grown record at the end of each meeting; may be empty
  /// @param earlier  meetings that were held before the run was taken up again
  explicit WarmupMeeting(int chains, MetricKind kind = MetricKind::dense, double metric_worth = 0,
                         std::vector<bool> jagged = {}, Save save = {}, WarmupRecord earlier = {})
      : kind_(kind),
        metric_worth_(metric_worth),
        jagged_(std::move(jagged)),
        save_(std::move(save)),
        record_(std::move(earlier)),
        results_(static_cast<std::size_t>(chains)) {}

  /// Waits for all chains, unless the meeting has been held.
  /// @param window  its number; every chain comes to the same ones in the same order
  /// @param result  of this chain's window
  /// @return what all chains go on with: pool() of all results
  /// @throws RunStopped if the run is stopped meanwhile
  LadderSettings meet(int chain, int window, LadderWindow result, const std::stop_token& stop);

  /// Whether the meeting at the end of that window has been held.
  bool was_held(int window) const;

 private:
  MetricKind kind_;
  double metric_worth_;
  std::vector<bool> jagged_;
  Save save_;
  mutable std::mutex mutex_;
  std::condition_variable_any complete_;
  WarmupRecord record_;
  std::vector<LadderWindow> results_;
  int arrived_ = 0;
};

}  // namespace patina
