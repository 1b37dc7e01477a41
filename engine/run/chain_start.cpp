#include "engine/run/chain_start.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/sampling/finite_evaluation.h"

namespace patina {
namespace {

constexpr double kOverdispersion = std::numbers::sqrt2;
constexpr int kTriesPerSpread = 3;
constexpr double kNarrowing = 0.7;

/// How far a start of twice the posterior's variance falls below the mode of a normal posterior: a chi-square
/// of so many degrees of freedom, mean and three standard deviations. Further below lies another basin, which
/// a chain of local moves would not leave in any run that a user waits for.
double deepest_fall(Eigen::Index dimension) {
  const auto d = static_cast<double>(dimension);
  return d + 3 * std::sqrt(2 * d);
}

Eigen::VectorXi uniform_levels(const std::vector<int>& levels, Rng& rng) {
  Eigen::VectorXi drawn(static_cast<Eigen::Index>(levels.size()));
  for (std::size_t i = 0; i < levels.size(); ++i) drawn[static_cast<Eigen::Index>(i)] = rng.below(levels[i]);
  return drawn;
}

}  // namespace

ChainState overdispersed_start(const LogDensity& target, const ChainState& mode, const Metric& laplace,
                               Rng& rng) {
  const Eigen::Index dimension = mode.position.continuous.size();
  const double lowest = mode.evaluation.log_density - deepest_fall(dimension);
  for (int i = 0; i < kStartTries; ++i) {
    ChainState start = mode;
    const double spread = kOverdispersion * std::pow(kNarrowing, i / kTriesPerSpread);
    start.position.continuous += spread * laplace.colour(rng.normals(dimension));
    if (i < kStartTries / 2) start.position.discrete = uniform_levels(target.discrete_levels(), rng);
    start.evaluation = evaluate_finite(target, start.position);
    if (start.evaluation.log_density >= lowest) return start;
  }
  return mode;
}

}  // namespace patina
