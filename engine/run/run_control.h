#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

namespace patina {

/// Thrown inside a run's threads to leave a computation once the run is asked to stop. Never leaves the run.
struct RunStopped {};

/// Pause, resume and stop, from any thread to a run's threads.
class RunControl {
 public:
  /// @param reason  one sentence for the status. A run that is paused already keeps its first reason.
  void pause(const std::string& reason) {
    const std::lock_guard lock(mutex_);
    if (!pause_reason_) pause_reason_ = reason;
  }

  void resume() {
    {
      const std::lock_guard lock(mutex_);
      pause_reason_.reset();
    }
    changed_.notify_all();
  }

  void stop() { stop_.request_stop(); }

  std::stop_token token() const { return stop_.get_token(); }

  /// Set while the run is paused.
  std::optional<std::string> pause_reason() const {
    const std::lock_guard lock(mutex_);
    return pause_reason_;
  }

  /// Blocks while the run is paused. @throws RunStopped
  void checkpoint() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop_.get_token(), [&] { return !pause_reason_; });
    if (stop_.stop_requested()) throw RunStopped();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<std::string> pause_reason_;
  std::stop_source stop_;
};

}  // namespace patina
