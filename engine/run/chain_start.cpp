#include "engine/run/chain_start.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/optimizer.h"
#include "engine/sampling/prior_draw.h"

namespace patina {
namespace {

constexpr double kOverdispersion = std::numbers::sqrt2;
constexpr double kNarrowing = 0.7;  // from one try to the next
constexpr int kClimb = 20;          // iterations
// Who is so far from it half-way gets there in one of twelve climbs, and a climb nearer to the mode costs no
// more (of 110 that were not nats away on leather_3 and wood_3).
constexpr double kHopeless = 100;  // nats

/// How far a start of twice the posterior's variance falls below the mode of a normal posterior: a chi-square
/// of so many degrees of freedom, mean and three standard deviations. Further below lies another basin, which
/// a chain of local moves would not leave in any run that a user waits for.
double deepest_fall(Eigen::Index dimension) {
  const auto d = static_cast<double>(dimension);
  return d + 3 * std::sqrt(2 * d);
}

/// From the mode towards a draw from the prior; jagged coordinates by Laplace's approximation.
Eigen::VectorXd draw_coordinates(const LogDensity& target, const Eigen::VectorXd& mode, const Metric& laplace,
                                 double spread, Rng& rng) {
  const Eigen::Index dimension = mode.size();
  const Eigen::VectorXd prior = rng.normals(dimension);
  const Eigen::VectorXd near = kOverdispersion * laplace.colour(rng.normals(dimension));
  const std::vector<bool> jagged = target.jagged();
  Eigen::VectorXd drawn = mode + spread * (prior - mode);
  for (Eigen::Index i = 0; i < dimension; ++i)
    if (!jagged.empty() && jagged[static_cast<std::size_t>(i)]) drawn[i] = mode[i] + spread * near[i];
  return drawn;
}

}  // namespace

ChainState overdispersed_start(const LogDensity& target, const ChainState& mode, const Metric& laplace,
                               Rng& rng) {
  double spread = 1;
  for (int i = 0; i < kStartTries; ++i, spread *= kNarrowing) {
    Position start = mode.position;
    start.continuous = draw_coordinates(target, mode.position.continuous, laplace, spread, rng);
    if (i < kStartTries / 2) start.discrete = draw_levels(target.discrete_levels(), rng);
    if (auto climbed = climbed_start(target, mode, start)) return std::move(*climbed);
  }
  return mode;
}

std::optional<ChainState> climbed_start(const LogDensity& target, const ChainState& mode,
                                        const Position& from) {
  OptimizerSettings climb;
  climb.max_iterations = kClimb;
  climb.good_enough = mode.evaluation.log_density - deepest_fall(mode.position.continuous.size());
  climb.hopeless = climb.good_enough - kHopeless;
  OptimizerResult climbed = maximize(target, from, climb);
  if (!(climbed.evaluation.log_density >= climb.good_enough)) return std::nullopt;
  return ChainState{std::move(climbed.position), std::move(climbed.evaluation)};
}

std::vector<std::string> start_names() { return {"map", "predict", "prior", "prior-mean", "values"}; }

ChainState start_at(const LogDensity& target, const std::function<Position(Rng&)>& propose, Rng& rng) {
  for (int i = 0; i < kStartTries; ++i) {
    const Position position = propose(rng);
    const Evaluation evaluation = evaluate_finite(target, position);
    if (std::isfinite(evaluation.log_density)) return {position, evaluation};
  }
  throw UserError(
      "A chain cannot start where it was told to, for nothing there can be compared with the photo: "
      "choose another start.");
}

}  // namespace patina
