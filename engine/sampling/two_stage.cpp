#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/journey.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

class TwoStage final : public Kernel {
 public:
  TwoStage(std::unique_ptr<Kernel> kernel, const LogDensity& cheap, int moves)
      : kernel_(std::move(kernel)), cheap_(cheap), moves_(moves) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    const ChainState here{state.position, value_finite(cheap_, state.position)};
    Journey journey;
    ChainState there = here;
    if (std::isfinite(here.evaluation.log_density))
      for (int i = 0; i < moves_; ++i) journey.add(kernel_->step(cheap_, settings, there, rng));
    TransitionInfo info = journey.info();
    ++info.evaluations;
    if (std::exchange(info.accepted, false)) {
      const double cheap_rise = there.evaluation.log_density - here.evaluation.log_density;
      there.evaluation = value_finite(target, there.position);
      ++info.evaluations;
      const double rise = there.evaluation.log_density - state.evaluation.log_density;
      const TransitionInfo decision =
          metropolis_step(info.move, rise - cheap_rise, kNeverDivergent, std::move(there), state, rng);
      info.accepted = decision.accepted;
      info.second_stage = decision.accept_probability;
    }
    info.energy = -state.evaluation.log_density;
    return info;
  }

  double target_acceptance() const override { return kernel_->target_acceptance(); }

 private:
  std::unique_ptr<Kernel> kernel_;
  const LogDensity& cheap_;
  int moves_;
};

}  // namespace

std::unique_ptr<Kernel> make_two_stage(std::unique_ptr<Kernel> kernel, const LogDensity& cheap, int moves) {
  if (moves < 1) throw std::invalid_argument("a proposal takes at least one move");
  return std::make_unique<TwoStage>(std::move(kernel), cheap, moves);
}

}  // namespace patina
