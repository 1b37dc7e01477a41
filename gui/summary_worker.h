#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/run/advice.h"
#include "engine/run/draw.h"
#include "engine/run/summarize.h"

namespace patina {

/// What the draws after warm-up say.
struct LiveSummary {
  RunSummary summary;
  std::vector<ParameterAdvice> advice;  ///< as exact as quantiles are
};

/// Keeps R-hat, ESS and moments up to date on a thread of its own, for about a thirtieth of a core. Up to
/// kMaxDraws draws after warm-up all figures are exact, about once a second or as often as that share allows.
/// Beyond, those of RunningSummary are brought up to date up to ten times a second, however many draws there
/// are; the others (quantiles, MCSE of the sd, directions, E-BFMI) are those of a copy of the draws of which
/// every second one was left out, again and again, so that ESS among them are lower bounds.
class SummaryWorker {
 public:
  static constexpr std::size_t kMaxDraws = 40000;

  /// @param wake  called from the worker's thread when a new summary lies ready
  SummaryWorker(ParameterTable table, std::function<void()> wake);
  ~SummaryWorker();

  void add(std::vector<Draw> draws);  ///< returns at once
  /// The newest summary, once.
  /// @throws what ended the worker's thread, once: there are no more summaries then
  std::optional<LiveSummary> take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace patina
