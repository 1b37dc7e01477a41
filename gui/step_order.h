#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace patina {

/// In which order several histories took their steps, so that one key takes back the last gesture, whichever
/// of them it moved.
/// @tparam Name  of a history
template <typename Name>
class StepOrder {
 public:
  /// To be told, after whatever may have changed histories, how many steps each has taken: History::steps().
  /// Steps of several that are told at once are of one gesture. Those that a history no longer knows of, as
  /// when it began anew, are forgotten.
  void note(std::initializer_list<std::pair<Name, std::ptrdiff_t>> histories) {
    for (const auto& [history, steps] : histories) {
      for (; known_[history] > steps; --known_[history]) forget_last(history);
      while (known_[history] + 1 < steps) begin(history, ++gesture_);
    }
    ++gesture_;
    for (const auto& [history, steps] : histories)
      if (known_[history] < steps) begin(history, gesture_);
  }

  /// @param step_back  takes back the last step of a history; false if it has none
  /// @return whether there was anything to take back
  template <typename StepBack>
  bool undo(StepBack step_back) {
    return move(past_, future_, step_back);
  }

  /// @param step_forward  makes the last step that was taken back again; false if there is none
  template <typename StepForward>
  bool redo(StepForward step_forward) {
    return move(future_, past_, step_forward);
  }

  bool can_undo() const { return !past_.empty(); }
  bool can_redo() const { return !future_.empty(); }

 private:
  struct Step {
    Name history;
    int gesture;
  };

  void begin(Name history, int gesture) {
    future_.clear();
    past_.push_back({history, gesture});
    ++known_[history];
  }

  template <typename Move>
  static bool move(std::vector<Step>& from, std::vector<Step>& to, Move move_history) {
    bool moved = false;
    while (!from.empty() && (!moved || from.back().gesture == to.back().gesture)) {
      const Step step = from.back();
      from.pop_back();
      if (!move_history(step.history)) continue;
      to.push_back(step);
      moved = true;
    }
    return moved;
  }

  void forget_last(Name history) {
    for (std::vector<Step>* steps : {&past_, &future_}) {
      const auto last = std::find_if(steps->rbegin(), steps->rend(),
                                     [&](const Step& step) { return step.history == history; });
      if (last == steps->rend()) continue;
      steps->erase(std::next(last).base());
      return;
    }
  }

  std::map<Name, std::ptrdiff_t> known_;
  std::vector<Step> past_, future_;  ///< oldest first; furthest first
  int gesture_ = 0;
};

}  // namespace patina
