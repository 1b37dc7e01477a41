#pragma once

#include <concepts>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace patina {

/// What a user can take back: the states of a value, one step a gesture, however many changes a gesture
/// makes. To begin anew, assign a new history.
template <std::equality_comparable State>
class History {
 public:
  static constexpr std::size_t kMost = 256;  ///< steps back; older ones are forgotten

  explicit History(State initial) : now_(std::move(initial)) {}

  const State& now() const { return now_; }

  /// @param new_gesture  whether a step begins here; otherwise the change belongs to the step before, unless
  /// that was undone or redone meanwhile. What had been undone can no longer be redone. A change to the same
  /// state is none, and a gesture that ends where it began leaves no step.
  void change(State state, bool new_gesture) {
    if (state == now_) {
      open_ &= !new_gesture;
      return;
    }
    future_.clear();
    if (new_gesture || !open_) {
      past_.push_back(std::move(now_));
      ++steps_;
    }
    if (past_.size() > kMost) past_.pop_front();
    now_ = std::move(state);
    open_ = now_ != past_.back();
    if (open_) return;
    past_.pop_back();
    --steps_;
  }

  /// @return whether there was a step to take back
  bool undo() {
    open_ = false;
    if (past_.empty()) return false;
    future_.push_back(std::exchange(now_, std::move(past_.back())));
    past_.pop_back();
    return true;
  }

  /// @return whether there was a step to make again
  bool redo() {
    open_ = false;
    if (future_.empty()) return false;
    past_.push_back(std::exchange(now_, std::move(future_.back())));
    future_.pop_back();
    return true;
  }

  /// How many changes began a step, so that whoever keeps several histories knows which moved last.
  std::ptrdiff_t steps() const { return steps_; }

  bool can_undo() const { return !past_.empty(); }
  bool can_redo() const { return !future_.empty(); }

 private:
  State now_;
  std::deque<State> past_;     ///< oldest first
  std::vector<State> future_;  ///< furthest first
  std::ptrdiff_t steps_ = 0;
  bool open_ = false;  ///< the last step is a gesture that may go on
};

}  // namespace patina
