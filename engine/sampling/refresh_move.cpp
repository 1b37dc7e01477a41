#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

using Indices = std::vector<Eigen::Index>;

struct Coordinates {
  Indices jagged, smooth;
};

Coordinates coordinates_of(const LogDensity& target) {
  const std::vector<bool> jagged = target.jagged();
  Coordinates coordinates;
  for (Eigen::Index i = 0; i < target.dimension(); ++i)
    (!jagged.empty() && jagged[static_cast<std::size_t>(i)] ? coordinates.jagged : coordinates.smooth)
        .push_back(i);
  return coordinates;
}

/// One of some coordinates, in proportion to the room that the metric leaves it while the others are held.
Eigen::Index choose_by_room(const Indices& coordinates, const Metric& metric, Rng& rng) {
  const Eigen::VectorXd room = metric.conditional_sds()(coordinates);
  double left = rng.uniform() * room.sum();
  for (std::size_t i = 0; i + 1 < coordinates.size(); ++i) {
    left -= room[static_cast<Eigen::Index>(i)];
    if (left < 0) return coordinates[i];
  }
  return coordinates.back();
}

/// Half of the time jagged coordinates, which nothing else moves, if there are any: one, or all at once (any
/// move along one leads to another wrinkle, and so does one along all); else a smooth one. The choice looks
/// at nothing that the move changes.
Indices choose_coordinates(const LogDensity& target, const Metric& metric, Rng& rng) {
  const auto [jagged, smooth] = coordinates_of(target);
  if (jagged.empty() || (!smooth.empty() && rng.uniform() < 0.5))
    return {choose_by_room(smooth, metric, rng)};
  if (rng.uniform() < 0.5) return jagged;
  return {jagged[static_cast<std::size_t>(rng.below(static_cast<int>(jagged.size())))]};
}

class RefreshMove final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    constexpr double kSmallestShare = 0.1;  // of a fresh draw in the proposal
    ChainState proposal{state.position, {}};
    const Indices moved = choose_coordinates(target, *settings.metric, rng);
    const double fresh = std::pow(kSmallestShare, rng.uniform());
    const Eigen::VectorXd here = state.position.continuous(moved);
    const Eigen::VectorXd there = std::sqrt(1 - fresh * fresh) * here + fresh * rng.normals(here.size());
    proposal.position.continuous(moved) = there;
    proposal.evaluation = value_finite(target, proposal.position);
    // The proposal is reversible with respect to N(0, I), whatever the share.
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density +
                             0.5 * (there.squaredNorm() - here.squaredNorm());
    return metropolis_step(MoveKind::refresh, log_ratio, kNeverDivergent, std::move(proposal), state, rng);
  }

  double target_acceptance() const override { return 0; }
};

}  // namespace

std::unique_ptr<Kernel> make_refresh_move() { return std::make_unique<RefreshMove>(); }

}  // namespace patina
