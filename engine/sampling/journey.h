#pragma once

#include <cmath>

#include "engine/sampling/chain_state.h"

namespace patina {

/// What several transitions did, as one: of continuous moves where there was one, for step sizes are adapted
/// by theirs. That one diverged is no news of the target: it costs a part of a proposal.
class Journey {
 public:
  void add(const TransitionInfo& info) {
    all_.evaluations += info.evaluations;
    all_.accepted |= info.accepted;
    const bool first_continuous = info.move == MoveKind::continuous && all_.move != MoveKind::continuous;
    if (first_continuous) counted_ = 0, sum_ = 0;
    if (counted_ > 0 && info.move != MoveKind::continuous && all_.move == MoveKind::continuous) return;
    all_.move = info.move;
    sum_ += std::isfinite(info.accept_probability) ? info.accept_probability : 0;
    all_.accept_probability = sum_ / ++counted_;
  }

  const TransitionInfo& info() const { return all_; }

 private:
  TransitionInfo all_{.move = MoveKind::discrete};
  int counted_ = 0;
  double sum_ = 0;
};

}  // namespace patina
