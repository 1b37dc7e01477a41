#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <mutex>

namespace patina {

/// How many events a second there were over the last few seconds. Safe to call from several threads.
class RateMeter {
 public:
  using Clock = std::chrono::steady_clock;

  void count(std::int64_t events, Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    Slot& slot = slots_[static_cast<std::size_t>(index(now) % kSlots)];
    if (slot.index != index(now)) slot = {index(now), 0};
    slot.events += events;
  }

  /// Events per second in the whole slots before now's.
  double per_second(Clock::time_point now) const {
    const std::lock_guard lock(mutex_);
    const std::int64_t current = index(now);
    std::int64_t events = 0;
    for (const Slot& slot : slots_)
      if (slot.index < current && slot.index > current - kSlots) events += slot.events;
    return static_cast<double>(events) / std::chrono::duration<double>((kSlots - 1) * kSlotLength).count();
  }

 private:
  static constexpr std::int64_t kSlots = 13;
  static constexpr std::chrono::milliseconds kSlotLength{250};
  struct Slot {
    std::int64_t index = -1;
    std::int64_t events = 0;
  };

  static std::int64_t index(Clock::time_point time) { return time.time_since_epoch() / kSlotLength; }

  mutable std::mutex mutex_;
  std::array<Slot, kSlots> slots_{};
};

}  // namespace patina
