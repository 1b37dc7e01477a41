#pragma once

#include "engine/run/draw.h"
#include "engine/run/run_status.h"

namespace patina {

/// Counts a chain's draws as they come.
class ChainTally {
 public:
  void add(const Draw& draw) {
    if (!draw.warmup && in_warmup_) {
      in_warmup_ = false;
      acceptance_sum_ = 0;
      counted_ = 0;
    }
    acceptance_sum_ += draw.accept_stat;
    ++counted_;
    status_.iteration = draw.iteration + 1;
    status_.acceptance = acceptance_sum_ / static_cast<double>(counted_);
    status_.divergences += draw.divergent && !draw.warmup;
    status_.step_size = draw.step_size;
  }

  const ChainStatus& status() const { return status_; }
  std::int64_t draws_after_warmup() const { return in_warmup_ ? 0 : counted_; }

 private:
  ChainStatus status_;
  double acceptance_sum_ = 0;
  std::int64_t counted_ = 0;  ///< of warm-up while in it, then of the draws after it
  bool in_warmup_ = true;
};

}  // namespace patina
