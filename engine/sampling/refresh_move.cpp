#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

using Indices = std::vector<Eigen::Index>;

/// Half of the time jagged coordinates, which nothing else moves, if there are any: one, or all at once (any
/// move along one leads to another wrinkle, and so does one along all); else any one.
Indices choose_coordinates(const LogDensity& target, Rng& rng) {
  Indices jagged;
  const std::vector<bool> is_jagged = target.jagged();
  for (std::size_t i = 0; i < is_jagged.size(); ++i)
    if (is_jagged[i]) jagged.push_back(static_cast<Eigen::Index>(i));
  if (jagged.empty() || rng.uniform() < 0.5) return {rng.below(static_cast<int>(target.dimension()))};
  if (rng.uniform() < 0.5) return jagged;
  return {jagged[static_cast<std::size_t>(rng.below(static_cast<int>(jagged.size())))]};
}

class RefreshMove final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings&, ChainState& state,
                      Rng& rng) const override {
    constexpr double kSmallestShare = 0.1;  // of a fresh draw in the proposal
    constexpr double kDivergentFall = std::numeric_limits<double>::infinity();  // a bad draw is no divergence
    ChainState proposal{state.position, {}};
    const Indices moved = choose_coordinates(target, rng);
    const double fresh = std::pow(kSmallestShare, rng.uniform());
    const Eigen::VectorXd here = state.position.continuous(moved);
    const Eigen::VectorXd there = std::sqrt(1 - fresh * fresh) * here + fresh * rng.normals(here.size());
    proposal.position.continuous(moved) = there;
    proposal.evaluation = evaluate_finite(target, proposal.position);
    // The proposal is reversible with respect to N(0, I), whatever the share.
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density +
                             0.5 * (there.squaredNorm() - here.squaredNorm());
    return metropolis_step(MoveKind::refresh, log_ratio, kDivergentFall, std::move(proposal), state, rng);
  }

  double target_acceptance() const override { return 0; }
};

}  // namespace

std::unique_ptr<Kernel> make_refresh_move() { return std::make_unique<RefreshMove>(); }

}  // namespace patina
