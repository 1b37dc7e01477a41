#pragma once

#include <cstddef>
#include <memory>

#include "engine/run/summarize.h"

namespace patina {

/// What of a RunSummary can be kept up to date while draws arrive, at a cost that does not grow with them;
/// how well it agrees with summarize_draws() over all of them says RunningConvergence.
class RunningSummary {
 public:
  explicit RunningSummary(const ParameterTable& table);
  ~RunningSummary();
  RunningSummary(RunningSummary&&) noexcept;
  RunningSummary& operator=(RunningSummary&&) noexcept;

  void add(const Draw& draw);  ///< of warm-up: left out

  /// Brings up to date, in a summary of some of these draws: mean, sd, R-hat and ESS of every quantity, chain
  /// means and the MCSE of the mean; draws, acceptance and divergences of every chain. Quantiles, their kin
  /// and directions stay as they are.
  void update(RunSummary& summary) const;

  std::size_t bytes() const;  ///< of the heap that it holds

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace patina
