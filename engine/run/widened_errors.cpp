#include "engine/run/widened_errors.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/posterior/simulate.h"
#include "engine/posterior/wider_errors.h"
#include "engine/run/controlled_density.h"
#include "engine/run/threads.h"
#include "engine/sampling/optimizer.h"
#include "engine/sampling/parallel_for.h"

namespace patina {
namespace {

WiderErrors measure(const Posterior& by_hand, const Position& match, IrregularityPool& pool,
                    std::uint64_t seed, RunShared& shared) {
  const Camera camera{.least_side = 0};  // no predictor looks at these photos
  shared.edit_status([](RunStatus& status) { status.message = "measuring what irregularities do"; });
  const Simulator simulator{.posterior = by_hand,
                            .pool = pool,
                            .camera = camera,
                            .seed = seed,
                            .threads = hardware_threads(),
                            .enter_thread = [] { use_tensor_threads(1); },
                            .simulated = [&] { shared.control.checkpoint(); }};
  return errors_of_irregularities(simulator, match);
}

}  // namespace

std::vector<OptimizerResult> climb_on(const LogDensity& target, const std::vector<Position>& ends) {
  constexpr std::size_t kMost = 4;  // those behind were far behind, too
  OptimizerSettings settings;
  settings.max_iterations = 30;  // what polynomials are learnt about need not be the very top
  std::vector<OptimizerResult> climbed(std::min(ends.size(), kMost));
  parallel_for(
      climbed.size(), hardware_threads(),
      [&](std::size_t i) { climbed[i] = maximize(target, ends[i], settings); },
      [] { use_tensor_threads(1); });
  std::ranges::stable_sort(climbed, std::ranges::greater{},
                           [](const OptimizerResult& end) { return end.evaluation.log_density; });
  return climbed;
}

ModeFound widened(const Posterior& by_hand, const std::vector<Position>& found, IrregularityPool& pool,
                  std::uint64_t seed, RunShared& shared) {
  assert(!found.empty());
  WiderErrors wider = measure(by_hand, found.front(), pool, seed, shared);
  const Posterior posterior = by_hand.with(wider);
  const ControlledDensity target(posterior, shared.control);
  ModeFound again = mode_of(posterior, climb_on(target, found), shared);
  again.wider = std::move(wider);
  return again;
}

}  // namespace patina
