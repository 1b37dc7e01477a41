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

/// Half of the time one of the jagged coordinates, which nothing else moves, if there are any; else any.
Eigen::Index choose_coordinate(const LogDensity& target, Rng& rng) {
  std::vector<Eigen::Index> jagged;
  const std::vector<bool> is_jagged = target.jagged();
  for (std::size_t i = 0; i < is_jagged.size(); ++i)
    if (is_jagged[i]) jagged.push_back(static_cast<Eigen::Index>(i));
  if (!jagged.empty() && rng.uniform() < 0.5)
    return jagged[static_cast<std::size_t>(rng.below(static_cast<int>(jagged.size())))];
  return rng.below(static_cast<int>(target.dimension()));
}

class RefreshMove final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings&, ChainState& state,
                      Rng& rng) const override {
    constexpr double kSmallestShare = 0.1;  // of a fresh draw in the proposal
    constexpr double kDivergentFall = std::numeric_limits<double>::infinity();  // a bad draw is no divergence
    ChainState proposal{state.position, {}};
    const Eigen::Index i = choose_coordinate(target, rng);
    const double fresh = std::pow(kSmallestShare, rng.uniform());
    const double here = state.position.continuous[i];
    const double there = std::sqrt(1 - fresh * fresh) * here + fresh * rng.normal();
    proposal.position.continuous[i] = there;
    proposal.evaluation = evaluate_finite(target, proposal.position);
    // The proposal is reversible with respect to N(0, 1), whatever the share.
    const double log_ratio =
        proposal.evaluation.log_density - state.evaluation.log_density + 0.5 * (there * there - here * here);
    return metropolis_step(MoveKind::refresh, log_ratio, kDivergentFall, std::move(proposal), state, rng);
  }

  double target_acceptance() const override { return 0; }
};

}  // namespace

std::unique_ptr<Kernel> make_refresh_move() { return std::make_unique<RefreshMove>(); }

}  // namespace patina
