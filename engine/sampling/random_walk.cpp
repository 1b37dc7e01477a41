#include <cassert>
#include <memory>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

class RandomWalk final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    assert(settings.metric && settings.metric->dimension() == state.position.continuous.size());
    ChainState proposal{state.position, {}};
    Eigen::VectorXd& x = proposal.position.continuous;
    x += settings.step_size * settings.metric->colour(rng.normals(x.size()));
    proposal.evaluation = value_finite(target, proposal.position);
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density;
    return metropolis_step(MoveKind::continuous, log_ratio, kNeverDivergent, std::move(proposal), state, rng);
  }

  /// Roberts, Gelman & Gilks 1997: the optimum as the dimension grows.
  double target_acceptance() const override { return 0.234; }
};

}  // namespace

std::unique_ptr<Kernel> make_random_walk() { return std::make_unique<RandomWalk>(); }

}  // namespace patina
