#include <memory>
#include <utility>
#include <vector>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"
#include "engine/sampling/prior_draw.h"

namespace patina {
namespace {

/// A move to levels that are drawn symmetrically, by propose(levels, now, rng).
template <typename Propose>
class DiscreteMove final : public Kernel {
 public:
  explicit DiscreteMove(Propose propose) : propose_(propose) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings&, ChainState& state,
                      Rng& rng) const override {
    ChainState proposal{state.position, {}};
    proposal.position.discrete = propose_(target.discrete_levels(), state.position.discrete, rng);
    if (proposal.position.discrete == state.position.discrete) return stay(state);

    proposal.evaluation = value_finite(target, proposal.position);
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density;
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

  Propose propose_;
};

Eigen::VectorXi any_levels(const std::vector<int>& levels, const Eigen::VectorXi& /*now*/, Rng& rng) {
  return draw_levels(levels, rng);
}

Eigen::VectorXi one_other_level(const std::vector<int>& levels, Eigen::VectorXi now, Rng& rng) {
  std::vector<Eigen::Index> with_others;
  for (Eigen::Index i = 0; i < now.size(); ++i)
    if (levels[i] > 1) with_others.push_back(i);
  if (with_others.empty()) return now;
  const Eigen::Index i = with_others[rng.below(static_cast<int>(with_others.size()))];
  now[i] = (now[i] + 1 + rng.below(levels[i] - 1)) % levels[i];
  return now;
}

}  // namespace

std::unique_ptr<Kernel> make_discrete_move() {
  return std::make_unique<DiscreteMove<decltype(&any_levels)>>(any_levels);
}

std::unique_ptr<Kernel> make_single_discrete_move() {
  return std::make_unique<DiscreteMove<decltype(&one_other_level)>>(one_other_level);
}

}  // namespace patina
