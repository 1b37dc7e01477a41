#include "engine/run/widened_errors.h"

#include <algorithm>
#include <vector>

#include "engine/run/controlled_density.h"
#include "engine/run/threads.h"
#include "engine/sampling/optimizer.h"
#include "engine/sampling/parallel_for.h"

namespace patina {

WiderErrors widen_errors(const Posterior& posterior, const Position& match, const RunSettings& settings,
                         RunShared& shared) {
  constexpr int kPhotos = 48;            // of a dozen directions that matter
  const Camera camera{.least_side = 0};  // no predictor looks at these photos
  const auto pool = make_pool(posterior.table(), kSimulatedSeeds);
  shared.edit_status([](RunStatus& status) { status.message = "measuring what irregularities do"; });
  const Simulator simulator{.posterior = posterior,
                            .pool = *pool,
                            .camera = camera,
                            .seed = settings.seed,
                            .threads = hardware_threads(),
                            .enter_thread = [] { use_tensor_threads(1); },
                            .simulated = [&] { shared.control.checkpoint(); }};
  return errors_of_irregularities(simulator, match, kPhotos);
}

void find_again(const Posterior& posterior, ModeFound& found, RunShared& shared) {
  constexpr std::size_t kMost = 4;  // those behind were far behind, too
  const ControlledDensity target(posterior, shared.control);
  found.basins.resize(std::min(found.basins.size(), kMost));
  std::vector<OptimizerResult> ends(found.basins.size());
  parallel_for(
      ends.size(), hardware_threads(),
      [&](std::size_t i) { ends[i] = maximize(target, posterior.position(found.basins[i].values)); },
      [] { use_tensor_threads(1); });
  std::ranges::stable_sort(ends, std::ranges::greater{},
                           [](const OptimizerResult& end) { return end.evaluation.log_density; });
  found.mode = {ends.front().position, ends.front().evaluation};
  found.laplace = std::make_shared<const Metric>(laplace_covariance(target, found.mode.position));
  found.basins.clear();
  for (const OptimizerResult& end : ends)
    found.basins.push_back({posterior.values(end.position), end.evaluation.log_density});
}

}  // namespace patina
