#include "engine/sampling/finite_evaluation.h"

#include <cmath>
#include <limits>

namespace patina {

namespace {

Evaluation held_to_contract(Evaluation evaluation, const Position& position) {
  if (std::isfinite(evaluation.log_density) && evaluation.gradient.allFinite()) return evaluation;
  return {-std::numeric_limits<double>::infinity(), Eigen::VectorXd::Zero(position.continuous.size())};
}

}  // namespace

Evaluation evaluate_finite(const LogDensity& target, const Position& position) {
  return held_to_contract(target.evaluate(position), position);
}

Evaluation value_finite(const LogDensity& target, const Position& position) {
  return held_to_contract(target.value(position), position);
}

}  // namespace patina
