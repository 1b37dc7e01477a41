#include <memory>
#include <utility>
#include <vector>

#include "engine/sampling/kernels.h"

namespace patina {
namespace {

/// A target as a function of y, see Shear.
class StraightenedTarget final : public LogDensity {
 public:
  StraightenedTarget(const LogDensity& target, const Shear& shear) : target_(target), shear_(shear) {}

  Eigen::Index dimension() const override { return target_.dimension(); }
  std::vector<int> discrete_levels() const override { return target_.discrete_levels(); }
  std::vector<bool> jagged() const override { return target_.jagged(); }

  Evaluation evaluate(const Position& y) const override {
    Evaluation evaluation = target_.evaluate({shear_.bend(y.continuous), y.discrete});
    evaluation.gradient = shear_.gradient_in_y(y.continuous[shear_.lead()], std::move(evaluation.gradient));
    return evaluation;
  }

 private:
  const LogDensity& target_;
  const Shear& shear_;
};

class Straightened final : public Kernel {
 public:
  explicit Straightened(std::unique_ptr<Kernel> kernel) : kernel_(std::move(kernel)) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    if (!settings.shear) return kernel_->step(target, settings, state, rng);
    const Shear& shear = *settings.shear;
    const Eigen::Index lead = shear.lead();
    const StraightenedTarget straightened(target, shear);
    const KernelSettings inner{settings.step_size, settings.metric, nullptr};
    ChainState y{{shear.straighten(state.position.continuous), state.position.discrete},
                 {state.evaluation.log_density,
                  shear.gradient_in_y(state.position.continuous[lead], state.evaluation.gradient)}};
    const TransitionInfo info = kernel_->step(straightened, inner, y, rng);
    if (!info.accepted)
      return info;  // a rejected draw repeats to the last bit, which there and back would not
    state.position = {shear.bend(y.position.continuous), y.position.discrete};
    state.evaluation = {y.evaluation.log_density,
                        shear.gradient_in_x(y.position.continuous[lead], std::move(y.evaluation.gradient))};
    return info;
  }

  double target_acceptance() const override { return kernel_->target_acceptance(); }

 private:
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace

std::unique_ptr<Kernel> make_straightened(std::unique_ptr<Kernel> kernel) {
  return std::make_unique<Straightened>(std::move(kernel));
}

}  // namespace patina
