#pragma once

#include <cstdint>
#include <vector>

#include "engine/diagnostics/running_convergence.h"
#include "engine/run/summarize.h"

namespace patina {

/// What of a RunSummary can be kept up to date while draws arrive, at a cost that does not grow with them;
/// how well it agrees with summarize_draws() over all of them says RunningConvergence.
class RunningSummary {
 public:
  explicit RunningSummary(const ParameterTable& table);

  void add(const Draw& draw);  ///< of warm-up: left out

  /// Brings up to date, in a summary of some of these draws: mean, sd, R-hat and ESS of every quantity, chain
  /// means and the MCSE of the mean; draws, acceptance and divergences of every chain. Quantiles, their kin
  /// and directions stay as they are.
  void update(RunSummary& summary) const;

  std::size_t bytes() const;  ///< of the heap that it holds

 private:
  struct ChainCount {
    std::int64_t draws = 0, divergences = 0;
    double acceptance_sum = 0;
  };

  std::size_t continuous_, discrete_;
  std::vector<RunningConvergence> quantities_;  ///< lp first, then the table's order
  std::vector<ChainCount> chains_;
};

}  // namespace patina
