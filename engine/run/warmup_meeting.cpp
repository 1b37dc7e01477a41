#include "engine/run/warmup_meeting.h"

#include <utility>

#include "engine/run/run_control.h"

namespace patina {

KernelSettings WarmupMeeting::meet(int chain, WindowResult result, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  results_[static_cast<std::size_t>(chain)] = std::move(result);
  const int meeting = meetings_;
  if (++arrived_ == static_cast<int>(results_.size())) {
    pooled_ = pool(results_, kind_, metric_worth_);
    arrived_ = 0;
    ++meetings_;
    complete_.notify_all();
  } else if (!complete_.wait(lock, stop, [&] { return meetings_ > meeting; })) {
    throw RunStopped();
  }
  // Nobody can start the next meeting's settings before all have left this one with theirs.
  return pooled_;
}

}  // namespace patina
