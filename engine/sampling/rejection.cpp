#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/journey.h"
#include "engine/sampling/kernels.h"

namespace patina {
namespace {

class Rejection final : public Kernel {
 public:
  Rejection(std::unique_ptr<Kernel> kernel, const LogDensity& envelope, int moves)
      : kernel_(std::move(kernel)), envelope_(envelope), moves_(moves) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    ChainState there{state.position, value_finite(envelope_, state.position)};
    Journey journey;
    TransitionInfo info{.second_stage = 0};
    for (int tries = 1; tries <= kMostTries && !info.accepted; ++tries) {
      for (int i = 0; i < moves_; ++i) journey.add(kernel_->step(envelope_, settings, there, rng));
      const Evaluation here = value_finite(target, there.position);
      const double share = std::min(std::exp(here.log_density - there.evaluation.log_density), 1.0);
      info.second_stage += (share - info.second_stage) / tries;
      info.accepted = rng.uniform() < share;
      if (info.accepted) state = {there.position, here};
      ++info.evaluations;
    }
    info.move = journey.info().move;
    info.accept_probability = journey.info().accept_probability;
    info.evaluations += journey.info().evaluations + 1;
    info.energy = -state.evaluation.log_density;
    return info;
  }

  double target_acceptance() const override { return kernel_->target_acceptance(); }

 private:
  static constexpr int kMostTries = 100;

  std::unique_ptr<Kernel> kernel_;
  const LogDensity& envelope_;
  int moves_;
};

}  // namespace

std::unique_ptr<Kernel> make_rejection(std::unique_ptr<Kernel> kernel, const LogDensity& envelope,
                                       int moves) {
  if (moves < 1) throw std::invalid_argument("a proposal takes at least one move");
  return std::make_unique<Rejection>(std::move(kernel), envelope, moves);
}

}  // namespace patina
