#pragma once

#include <chrono>

namespace patina {

/// Holds back figures that nobody could read so often: bars and curves that a draw more changes a little.
class Pace {
 public:
  /// Whether it is time again; if so, the next time is an interval from now.
  bool due() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return false;
    next_ = now + kInterval;
    return true;
  }

 private:
  static constexpr std::chrono::milliseconds kInterval{250};
  std::chrono::steady_clock::time_point next_;
};

}  // namespace patina
