#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>

namespace patina {

/// Passes a wake on unless one was passed on less than an interval ago: samplers may report every draw, the
/// window need not redraw for each. What is dropped shows up with the next one; who needs the last one polls.
/// @return a function that may be called from any thread
inline std::function<void()> limited_wake(std::function<void()> wake, std::chrono::milliseconds interval) {
  using Clock = std::chrono::steady_clock;
  auto next = std::make_shared<std::atomic<Clock::rep>>(Clock::time_point::min().time_since_epoch().count());
  return [wake = std::move(wake), interval, next] {
    const Clock::time_point now = Clock::now();
    Clock::rep due = next->load();
    if (now.time_since_epoch().count() < due) return;
    if (next->compare_exchange_strong(due, (now + interval).time_since_epoch().count())) wake();
  };
}

}  // namespace patina
