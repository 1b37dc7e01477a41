#include "engine/run/chain_start.h"

#include <cmath>
#include <utility>
#include <vector>

#include "engine/sampling/finite_evaluation.h"

namespace patina {
namespace {

constexpr double kOverdispersion = 2;

/// A normal posterior falls by 2 dim on average at such a start; more than five times that is no start but
/// a long way home.
constexpr double kDeepestFallPerDimension = 10;

Eigen::VectorXi uniform_levels(const std::vector<int>& levels, Rng& rng) {
  Eigen::VectorXi drawn(static_cast<Eigen::Index>(levels.size()));
  for (std::size_t i = 0; i < levels.size(); ++i) drawn[static_cast<Eigen::Index>(i)] = rng.below(levels[i]);
  return drawn;
}

}  // namespace

ChainState overdispersed_start(const LogDensity& target, const ChainState& mode, const Metric& laplace,
                               Rng& rng) {
  const Eigen::Index dimension = mode.position.continuous.size();
  const double lowest =
      mode.evaluation.log_density - kDeepestFallPerDimension * static_cast<double>(dimension + 1);
  ChainState best = mode;
  bool found = false;
  for (int i = 0; i < kStartTries; ++i) {
    ChainState start = mode;
    start.position.continuous += kOverdispersion * laplace.colour(rng.normals(dimension));
    if (i < kStartTries / 2) start.position.discrete = uniform_levels(target.discrete_levels(), rng);
    start.evaluation = evaluate_finite(target, start.position);
    if (start.evaluation.log_density >= lowest) return start;
    if (std::isfinite(start.evaluation.log_density) &&
        (!found || start.evaluation.log_density > best.evaluation.log_density)) {
      best = std::move(start);
      found = true;
    }
  }
  return best;
}

}  // namespace patina
