#include <cmath>
#include <utility>

#include "engine/sampling/leapfrog.h"
#include "engine/sampling/metropolis.h"
#include "engine/sampling/warmup.h"

namespace patina {

double initial_step_size(const LogDensity& target, const KernelSettings& settings, ChainState state,
                         Rng& rng) {
  if (!complete(target, state)) return settings.step_size;
  constexpr int kMostTries = 30;
  const double accepted = std::log(0.8);
  double step = settings.step_size;
  int direction = 0;  // unknown until the first try
  for (int tries = 0; tries < kMostTries; ++tries) {
    PhasePoint point{state, rng.normals(state.position.continuous.size())};
    const double before = energy(point);
    leapfrog(target, *settings.metric, step, point);
    const int wanted = before - energy(point) > accepted ? 1 : -1;  // -1 for NaN
    if (direction == 0) direction = wanted;
    if (wanted != direction) break;
    step *= direction > 0 ? 2 : 0.5;
  }
  return step;
}

}  // namespace patina
