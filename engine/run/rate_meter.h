#pragma once

#include <algorithm>
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
    if (index(now) - newest_ >= kSlots) stream_begin_ = index(now);
    newest_ = index(now);
    Slot& slot = slots_[static_cast<std::size_t>(index(now) % kSlots)];
    if (slot.index != index(now)) slot = {index(now), 0};
    slot.events += events;
  }

  /// Events per second in the whole slots before now's, since the stream began if that was later.
  double per_second(Clock::time_point now) const {
    const std::lock_guard lock(mutex_);
    const std::int64_t current = index(now);
    const std::int64_t span = std::min(current - stream_begin_, kSlots - 1);
    if (span <= 0) return 0;
    std::int64_t events = 0;
    for (const Slot& slot : slots_)
      if (slot.index < current && slot.index >= current - span) events += slot.events;
    return static_cast<double>(events) / std::chrono::duration<double>(span * kSlotLength).count();
  }

 private:
  static constexpr std::int64_t kSlots = 13;
  static constexpr std::chrono::milliseconds kSlotLength{250};
  static constexpr std::int64_t kNever = -1'000'000;
  struct Slot {
    std::int64_t index = kNever;
    std::int64_t events = 0;
  };

  static std::int64_t index(Clock::time_point time) { return time.time_since_epoch() / kSlotLength; }

  mutable std::mutex mutex_;
  std::array<Slot, kSlots> slots_{};
  std::int64_t newest_ = kNever;
  std::int64_t stream_begin_ = 0;  ///< first slot after a silence longer than all slots
};

}  // namespace patina
