#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <vector>

#include "gui/explorer_model.h"

namespace patina {

/// A kind of solution among the draws (engine/diagnostics/modes.h).
struct FoundMode {
  double share = 0;      ///< of the draws
  std::size_t best = 0;  ///< its draw with the highest lp
};

/// Finds the modes of the draws on a thread of its own, anew whenever a quarter more has come. Of many draws
/// it looks at a few thousand, spread evenly over the run.
class ModeFinder {
 public:
  static constexpr std::size_t kLeastDraws = 200;  ///< below which clouds tell nothing

  /// @param wake  called from the thread when it is done
  explicit ModeFinder(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Takes in what was found, and begins to look where it is time to.
  /// @param run  tells one run's draws from another's
  void follow(const ExplorerModel& model, int run);

  const std::vector<FoundMode>& modes() const { return modes_; }  ///< the one with most draws first

 private:
  std::function<void()> wake_;
  std::vector<FoundMode> modes_;
  int run_ = -1;
  std::size_t draws_ = 0;  ///< that were there when the search began whose modes these are, or will be
  std::future<std::vector<FoundMode>> search_;
  int search_run_ = -1;
};

}  // namespace patina
