#include "engine/sampling/leapfrog.h"

#include "engine/sampling/finite_evaluation.h"

namespace patina {

void leapfrog(const LogDensity& target, const Metric& metric, double step_size, PhasePoint& point) {
  ChainState& state = point.state;
  point.momentum += step_size / 2 * metric.colour_transposed(state.evaluation.gradient);
  state.position.continuous += step_size * metric.colour(point.momentum);
  state.evaluation = evaluate_finite(target, state.position);
  point.momentum += step_size / 2 * metric.colour_transposed(state.evaluation.gradient);
}

}  // namespace patina
