#include "engine/sampling/leapfrog.h"

#include "engine/sampling/finite_evaluation.h"

namespace patina {

double energy(const PhasePoint& point) {
  return 0.5 * point.momentum.squaredNorm() - point.state.evaluation.log_density;
}

void leapfrog(const LogDensity& target, const Metric& metric, double step, PhasePoint& point) {
  ChainState& state = point.state;
  point.momentum += step / 2 * metric.colour_transposed(state.evaluation.gradient);
  state.position.continuous += step * metric.colour(point.momentum);
  state.evaluation = evaluate_finite(target, state.position);
  point.momentum += step / 2 * metric.colour_transposed(state.evaluation.gradient);
}

}  // namespace patina
