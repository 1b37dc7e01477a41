#include "engine/sampling/finite_evaluation.h"

#include <cmath>
#include <limits>

namespace patina {

Evaluation evaluate_finite(const LogDensity& target, const Position& position) {
  Evaluation evaluation = target.evaluate(position);
  if (std::isfinite(evaluation.log_density) && evaluation.gradient.allFinite()) return evaluation;
  return {-std::numeric_limits<double>::infinity(), Eigen::VectorXd::Zero(position.continuous.size())};
}

}  // namespace patina
