#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/run/draw.h"
#include "engine/run/summarize.h"

namespace patina {

/// Keeps R-hat, ESS and moments up to date on a thread of its own, about once a second and for at most a
/// tenth of a core. It keeps its own copy of the draws after warm-up; beyond kMaxDraws every second one is
/// left out (again and again), so that its ESS is then a lower bound.
class SummaryWorker {
 public:
  static constexpr std::size_t kMaxDraws = 40000;

  /// @param wake  called from the worker's thread when a new summary lies ready
  SummaryWorker(ParameterTable table, std::function<void()> wake);
  ~SummaryWorker();

  void add(std::vector<Draw> draws);  ///< returns at once
  std::optional<RunSummary> take();   ///< the newest summary, once

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace patina
