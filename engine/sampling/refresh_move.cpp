#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

class RefreshMove final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings&, ChainState& state,
                      Rng& rng) const override {
    constexpr double kSmallestShare = 0.1;  // of a fresh draw in the proposal
    constexpr double kDivergentFall = std::numeric_limits<double>::infinity();  // a bad draw is no divergence
    ChainState proposal{state.position, {}};
    const int i = rng.below(static_cast<int>(target.dimension()));
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
