#include <memory>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

class MirrorMove final : public Kernel {
 public:
  explicit MirrorMove(Eigen::Index coordinate) : coordinate_(coordinate) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings&, ChainState& state,
                      Rng& rng) const override {
    ChainState proposal{state.position, {}};
    proposal.position.continuous[coordinate_] *= -1;
    proposal.evaluation = value_finite(target, proposal.position);
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density;
    return metropolis_step(MoveKind::refresh, log_ratio, kNeverDivergent, std::move(proposal), state, rng);
  }

  double target_acceptance() const override { return 0; }

 private:
  Eigen::Index coordinate_;
};

}  // namespace

std::unique_ptr<Kernel> make_mirror_move(Eigen::Index coordinate) {
  return std::make_unique<MirrorMove>(coordinate);
}

}  // namespace patina
