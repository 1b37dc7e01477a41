#include "engine/sampling/ladder.h"

namespace patina {

LadderSettings pool(const std::vector<LadderWindow>& chains, MetricKind kind, double metric_worth,
                    const std::vector<bool>& jagged) {
  const std::vector<double>& betas = chains.front().betas;
  SwapRecord swaps(betas.size());
  for (const LadderWindow& chain : chains) swaps.add(chain.swaps);
  LadderSettings pooled{equalised_ladder(betas, swaps.rejection()), {}};
  for (std::size_t i = 0; i < chains.front().rungs.size(); ++i) {
    std::vector<WindowResult> results;
    for (const LadderWindow& chain : chains) results.push_back(chain.rungs[i]);
    pooled.rungs.push_back(pool(results, kind, metric_worth, jagged));
  }
  return pooled;
}

}  // namespace patina
