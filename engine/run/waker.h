#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace patina {

/// Calls a front end's wake function when there is news, at most about 60 times a second, from a thread of
/// its own; no news is left untold. Whoever has news only sets a flag.
class Waker {
 public:
  explicit Waker(std::function<void()> wake) : wake_(std::move(wake)) {
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
    constexpr std::chrono::milliseconds kInterval(16);
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [&] { return news_; })) {
      news_ = false;
      lock.unlock();
      wake_();
      lock.lock();
      changed_.wait_for(lock, stop, kInterval, [] { return false; });
    }
  }

  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool news_ = false;
  std::jthread thread_;  // last: joins before what it uses goes
};

}  // namespace patina
