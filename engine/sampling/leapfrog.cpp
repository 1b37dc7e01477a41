#include "engine/sampling/leapfrog.h"

#include "engine/sampling/finite_evaluation.h"

namespace patina {

double energy(const PhasePoint& point) {
  return 0.5 * point.momentum.squaredNorm() - point.state.evaluation.log_density;
}

void leapfrog(const LogDensity& target, const Metric& metric, double step, PhasePoint& point) {
  ChainState& state = point.state;
  if (point.pull.size() == 0) point.pull = metric.colour_transposed(state.evaluation.gradient);
  point.momentum += step / 2 * point.pull;
  state.position.continuous += step * metric.colour(point.momentum);
  state.evaluation = evaluate_finite(target, state.position);
  point.pull = metric.colour_transposed(state.evaluation.gradient);
  point.momentum += step / 2 * point.pull;
}

}  // namespace patina
