#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

class DiscreteMove final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings&, ChainState& state,
                      Rng& rng) const override {
    ChainState proposal{state.position, {}};
    const std::vector<int> levels = target.discrete_levels();
    for (Eigen::Index i = 0; i < proposal.position.discrete.size(); ++i)
      proposal.position.discrete[i] = rng.below(levels[i]);
    if (proposal.position.discrete == state.position.discrete) return stay(state);

    proposal.evaluation = evaluate_finite(target, proposal.position);
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density;
    // However far a level falls short, nothing diverged: it is just a bad level.
    constexpr double kNeverDivergent = std::numeric_limits<double>::infinity();
    return metropolis_step(MoveKind::discrete, log_ratio, kNeverDivergent, std::move(proposal), state, rng);
  }

  double target_acceptance() const override { return 0; }

 private:
  /// The current levels came up again: accepted for certain, at no evaluation.
  static TransitionInfo stay(const ChainState& state) {
    TransitionInfo info;
    info.move = MoveKind::discrete;
    info.accept_probability = 1;
    info.accepted = true;
    info.energy = -state.evaluation.log_density;
    return info;
  }
};

}  // namespace

std::unique_ptr<Kernel> make_discrete_move() { return std::make_unique<DiscreteMove>(); }

}  // namespace patina
