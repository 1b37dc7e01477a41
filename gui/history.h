#pragma once

#include <cstddef>
#include <deque>
#include <utility>

namespace patina {

/// What a user did, as the states that it led to: undo goes back along them, redo forth again. States are
/// values that can be copied cheaply and compared.
template <typename State>
class History {
 public:
  static constexpr std::size_t kMostSteps = 500;  ///< older ones are forgotten

  explicit History(State start = {}) { states_.push_back(std::move(start)); }

  /// A step to `now`, unless that is where we are; what had been undone can no longer be redone then.
  void note(const State& now) {
    if (now == states_[here_]) return;
    states_.resize(here_ + 1);
    states_.push_back(now);
    if (states_.size() > kMostSteps + 1) states_.pop_front();
    here_ = states_.size() - 1;
  }

  bool can_undo() const { return here_ > 0; }
  bool can_redo() const { return here_ + 1 < states_.size(); }

  /// The state to go to; where there is no step to undo or redo, the one that we are at.
  const State& undo() { return states_[can_undo() ? --here_ : here_]; }
  const State& redo() { return states_[can_redo() ? ++here_ : here_]; }

 private:
  std::deque<State> states_;
  std::size_t here_ = 0;
};

}  // namespace patina
