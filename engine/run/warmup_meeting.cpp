#include "engine/run/warmup_meeting.h"

#include <utility>

#include "engine/run/run_control.h"

namespace patina {

KernelSettings WarmupMeeting::meet(int chain, WindowReport report, bool adapts_metric,
                                   const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  reports_[static_cast<std::size_t>(chain)] = std::move(report);
  const int meeting = meetings_;
  if (++arrived_ == static_cast<int>(reports_.size())) {
    settings_ = pooled(reports_, adapts_metric, settings_.metric);
    arrived_ = 0;
    ++meetings_;
    complete_.notify_all();
  } else if (!complete_.wait(lock, stop, [&] { return meetings_ > meeting; })) {
    throw RunStopped();
  }
  // Nobody can end the next meeting before all have left this one.
  return settings_;
}

}  // namespace patina
