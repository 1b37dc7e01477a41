#include <memory>
#include <utility>
#include <vector>

#include "engine/sampling/kernels.h"

namespace patina {
namespace {

/// A target as a function of y, see Straightening.
class StraightenedTarget final : public LogDensity {
 public:
  StraightenedTarget(const LogDensity& target, const Straightening& map) : target_(target), map_(map) {}

  Eigen::Index dimension() const override { return target_.dimension(); }
  std::vector<int> discrete_levels() const override { return target_.discrete_levels(); }
  std::vector<bool> jagged() const override { return target_.jagged(); }

  Evaluation evaluate(const Position& y) const override {
    return map_.density_of_y(y.continuous, target_.evaluate({map_.bend(y.continuous), y.discrete}));
  }
  Evaluation value(const Position& y) const override {
    return map_.density_of_y(y.continuous, target_.value({map_.bend(y.continuous), y.discrete}));
  }

 private:
  const LogDensity& target_;
  const Straightening& map_;
};

class Straightened final : public Kernel {
 public:
  explicit Straightened(std::unique_ptr<Kernel> kernel) : kernel_(std::move(kernel)) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    if (!settings.straightening) return kernel_->step(target, settings, state, rng);
    const Straightening& map = *settings.straightening;
    const StraightenedTarget straightened(target, map);
    const KernelSettings inner{settings.step_size, settings.metric};
    const Eigen::VectorXd y = map.straighten(state.position.continuous);
    ChainState in_y{{y, state.position.discrete}, map.density_of_y(y, state.evaluation)};
    TransitionInfo info = kernel_->step(straightened, inner, in_y, rng);
    info.energy +=
        in_y.evaluation.log_density;  // the kinetic part alone, to the last bit where there is none
    if (!info.accepted) {
      // A rejected draw repeats to the last bit, which there and back would not; a gradient that was missing
      // is kept.
      if (state.evaluation.gradient.size() == 0)
        state.evaluation.gradient = map.density_of_x(in_y.position.continuous, in_y.evaluation).gradient;
    } else {
      state.position = {map.bend(in_y.position.continuous), in_y.position.discrete};
      state.evaluation = map.density_of_x(in_y.position.continuous, in_y.evaluation);
    }
    info.energy -= state.evaluation.log_density;
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
