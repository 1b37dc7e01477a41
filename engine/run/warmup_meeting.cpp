#include "engine/run/warmup_meeting.h"

#include <utility>

#include "engine/run/run_control.h"

namespace patina {

LadderSettings WarmupMeeting::meet(int chain, int window, LadderWindow result, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (const auto held = record_.find(window); held != record_.end()) return held->second;
  results_[static_cast<std::size_t>(chain)] = std::move(result);
  if (++arrived_ == static_cast<int>(results_.size())) {
    arrived_ = 0;
    WarmupRecord grown = record_;
    grown[window] = pool(results_, kind_, metric_worth_, jagged_);
    if (save_) save_(grown);
    record_ = std::move(grown);
    complete_.notify_all();
  } else if (!complete_.wait(lock, stop, [&] { return record_.contains(window); })) {
    throw RunStopped();
  }
  return record_.at(window);
}

bool WarmupMeeting::was_held(int window) const {
  const std::lock_guard lock(mutex_);
  return record_.contains(window);
}

}  // namespace patina
