#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace patina {

/// The newest value of something that changes: any thread sets it, any thread gets a copy. The lock is held
/// for a swap of pointers only; copies are made and old values destroyed outside it.
template <typename T>
class LatestValue {
 public:
  explicit LatestValue(T first = {}) : value_(std::make_shared<const T>(std::move(first))) {}

  void set(T value) {
    auto fresh = std::make_shared<const T>(std::move(value));
    const std::lock_guard lock(mutex_);
    value_.swap(fresh);
  }

  T get() const {
    std::shared_ptr<const T> held;
    {
      const std::lock_guard lock(mutex_);
      held = value_;
    }
    return *held;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
};

}  // namespace patina
