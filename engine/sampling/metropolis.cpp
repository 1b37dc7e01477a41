#include "engine/sampling/metropolis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/sampling/finite_evaluation.h"

namespace patina {

TransitionInfo metropolis_step(MoveKind move, double log_ratio, double divergent_below, ChainState proposal,
                               ChainState& state, Rng& rng) {
  const double uniform = rng.uniform();
  const double change = proposal.evaluation.log_density - state.evaluation.log_density;
  const bool finite = std::isfinite(proposal.evaluation.log_density);

  TransitionInfo info;
  info.move = move;
  info.divergent = !finite || change < -divergent_below;
  if (finite && !std::isnan(log_ratio)) info.accept_probability = std::min(1.0, std::exp(log_ratio));
  info.accepted = uniform < info.accept_probability;
  if (info.accepted) state = std::move(proposal);
  info.evaluations = 1;
  info.energy = -state.evaluation.log_density;
  return info;
}

TransitionInfo metropolis_step_by_value(MoveKind move, double log_ratio, const LogDensity& target,
                                        ChainState proposal, ChainState& state, Rng& rng) {
  const ChainState before = state;
  TransitionInfo info = metropolis_step(move, log_ratio, std::numeric_limits<double>::infinity(),
                                        std::move(proposal), state, rng);
  if (!info.accepted || state.evaluation.gradient.size() == state.position.continuous.size()) return info;
  state.evaluation = evaluate_finite(target, state.position);
  ++info.evaluations;
  if (!std::isfinite(state.evaluation.log_density)) {
    state = before;
    info.accepted = false;
    info.accept_probability = 0;
  }
  info.energy = -state.evaluation.log_density;
  return info;
}

}  // namespace patina
