#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <vector>

namespace patina {

/// In which order several histories took their steps, so that one key takes back the last step of all.
/// @tparam Name  of a history
template <typename Name>
class StepOrder {
 public:
  /// To be told, after whatever may have changed a history, how many steps it has taken: History::steps().
  /// Steps that it no longer knows of, as when it began anew, are forgotten.
  void note(Name history, std::ptrdiff_t steps) {
    std::ptrdiff_t& known = known_[history];
    if (steps > known) future_.clear();
    for (; known < steps; ++known) past_.push_back(history);
    for (; known > steps; --known) forget_last(history);
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
  template <typename Step>
  static bool move(std::vector<Name>& from, std::vector<Name>& to, Step step) {
    while (!from.empty()) {
      const Name history = from.back();
      from.pop_back();
      if (!step(history)) continue;
      to.push_back(history);
      return true;
    }
    return false;
  }

  void forget_last(Name history) {
    for (std::vector<Name>* names : {&past_, &future_}) {
      const auto last = std::find(names->rbegin(), names->rend(), history);
      if (last == names->rend()) continue;
      names->erase(std::next(last).base());
      return;
    }
  }

  std::map<Name, std::ptrdiff_t> known_;
  std::vector<Name> past_, future_;  ///< oldest first; furthest first
};

}  // namespace patina
