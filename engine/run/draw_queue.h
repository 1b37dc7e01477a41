#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "engine/run/draw.h"

namespace patina {

/// Every draw arrives, in each chain's order. Samplers push, the window takes all there is once a frame.
/// The lock is held for a push_back or a swap of two vectors only.
class DrawQueue {
 public:
  void push(Draw draw) {
    const std::lock_guard lock(mutex_);
    draws_.push_back(std::move(draw));
  }

  std::vector<Draw> take_all() {
    std::vector<Draw> taken;
    const std::lock_guard lock(mutex_);
    taken.swap(draws_);
    return taken;
  }

 private:
  std::mutex mutex_;
  std::vector<Draw> draws_;
};

}  // namespace patina
