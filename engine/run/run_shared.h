#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include "engine/error.h"
#include "engine/run/draw_queue.h"
#include "engine/run/first_line.h"
#include "engine/run/latest_value.h"
#include "engine/run/rate_meter.h"
#include "engine/run/run_control.h"
#include "engine/run/run_status.h"
#include "engine/run/waker.h"

namespace patina {

/// What a run's threads and its front end share.
class RunShared {
 public:
  explicit RunShared(std::function<void()> wake) : waker(std::move(wake)) {}

  /// Changes the status and tells the front end. The lock here is the writers' own: readers go by newest().
  template <typename Change>
  void edit_status(Change change) {
    {
      const std::lock_guard lock(status_mutex_);
      change(status_);
      latest_.set(status_);
    }
    waker.note();
  }

  RunStatus newest_status() const { return latest_.get(); }

  /// Writes to disk. A failure that the user can mend (a full disk) pauses the run and says so; after
  /// resume() the same piece is tried again. @throws RunStopped
  template <typename Write>
  void write_or_pause(Write write) {
    for (;;) {
      try {
        return write();
      } catch (const UserError& error) {
        control.pause(error.what());
        waker.note();
        control.checkpoint();
      }
    }
  }

  /// Ends the run with a reason; the first one counts.
  void fail(const std::string& reason) {
    {
      const std::lock_guard lock(status_mutex_);
      if (failure_.empty()) failure_ = first_line(reason);
    }
    control.stop();
  }

  std::string failure() const {
    const std::lock_guard lock(status_mutex_);
    return failure_;
  }

  RunControl control;
  DrawQueue draws;
  RateMeter draw_rate;
  Waker waker;

 private:
  mutable std::mutex status_mutex_;
  RunStatus status_;
  LatestValue<RunStatus> latest_;
  std::string failure_;  ///< empty: none
};

}  // namespace patina
