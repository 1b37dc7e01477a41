#include "engine/sampling/metropolis.h"

#include <algorithm>
#include <cmath>
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

std::optional<int> complete(const LogDensity& target, ChainState& state) {
  if (state.evaluation.gradient.size() == state.position.continuous.size()) return 0;
  Evaluation whole = evaluate_finite(target, state.position);
  if (!std::isfinite(whole.log_density)) return std::nullopt;
  state.evaluation = std::move(whole);
  return 1;
}

TransitionInfo with_gradient(const LogDensity& target, ChainState& state,
                             const std::function<TransitionInfo()>& step) {
  const std::optional<int> completed = complete(target, state);
  if (completed) {
    TransitionInfo info = step();
    info.evaluations += *completed;
    return info;
  }
  TransitionInfo held;
  held.divergent = true;
  held.evaluations = 1;
  held.energy = -state.evaluation.log_density;
  return held;
}

}  // namespace patina
