#pragma once

#include <chrono>
#include <thread>

namespace patina {

/// Waits up to two minutes: machines are slow. Returns whether it came true.
/// @param pause  between one look and the next
template <typename Condition>
bool comes_true(Condition condition, std::chrono::milliseconds pause = std::chrono::milliseconds(10)) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  for (; std::chrono::steady_clock::now() < limit; std::this_thread::sleep_for(pause))
    if (condition()) return true;
  return condition();
}

}  // namespace patina
