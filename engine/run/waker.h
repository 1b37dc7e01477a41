#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace patina {

/// Calls a front end's wake function when there is news, at most once an interval, from a thread of its own;
/// no news is left untold. Whoever has news only sets a flag.
class Waker {
 public:
  explicit Waker(std::function<void()> wake,
                 std::chrono::milliseconds interval = std::chrono::milliseconds(16))
      : wake_(std::move(wake)), interval_(interval) {
    if (wake_) thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }

  void note() {
    {
      const std::lock_guard lock(mutex_);
      news_ = true;
    }
    changed_.notify_one();
  }

 private:
  void serve(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [&] { return news_; })) {
      news_ = false;
      lock.unlock();
      wake_();
      lock.lock();
      changed_.wait_for(lock, stop, interval_, [] { return false; });
    }
  }

  std::function<void()> wake_;
  std::chrono::milliseconds interval_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool news_ = false;
  std::jthread thread_;  // last: joins before what it uses goes
};

}  // namespace patina
