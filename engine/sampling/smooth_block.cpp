#include <memory>
#include <utility>
#include <vector>

#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

using Indices = std::vector<Eigen::Index>;

Indices smooth_coordinates(const LogDensity& target) {
  const std::vector<bool> jagged = target.jagged();
  Indices smooth;
  for (Eigen::Index i = 0; i < target.dimension(); ++i)
    if (jagged.empty() || !jagged[static_cast<std::size_t>(i)]) smooth.push_back(i);
  return smooth;
}

/// A target as a function of its smooth coordinates, all else held where `place` has it.
class Conditional final : public LogDensity {
 public:
  Conditional(const LogDensity& target, const Indices& smooth, Position place)
      : target_(target), smooth_(smooth), place_(std::move(place)) {}

  Eigen::Index dimension() const override { return static_cast<Eigen::Index>(smooth_.size()); }

  Evaluation evaluate(const Position& position) const override {
    Evaluation evaluation = target_.evaluate(whole(position));
    evaluation.gradient = Eigen::VectorXd(evaluation.gradient(smooth_));
    return evaluation;
  }

  Position whole(const Position& position) const {
    Position whole = place_;
    whole.continuous(smooth_) = position.continuous;
    return whole;
  }

 private:
  const LogDensity& target_;
  const Indices& smooth_;
  Position place_;
};

class SmoothBlock final : public Kernel {
 public:
  explicit SmoothBlock(std::unique_ptr<Kernel> kernel) : kernel_(std::move(kernel)) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    return with_gradient(target, state, [&] { return move(target, settings, state, rng); });
  }

  double target_acceptance() const override { return kernel_->target_acceptance(); }

 private:
  TransitionInfo move(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const {
    const Indices smooth = smooth_coordinates(target);
    const Conditional conditional(target, smooth, state.position);
    const KernelSettings block{settings.step_size, settings.metric->conditional(smooth)};
    ChainState inner{{state.position.continuous(smooth), {}},
                     {state.evaluation.log_density, state.evaluation.gradient(smooth)}};
    const TransitionInfo info = kernel_->step(conditional, block, inner, rng);
    if (info.accepted) {
      state.position = conditional.whole(inner.position);
      state.evaluation.log_density = inner.evaluation.log_density;
      state.evaluation.gradient(smooth) = inner.evaluation.gradient;
    }
    return info;
  }

  std::unique_ptr<Kernel> kernel_;
};

}  // namespace

std::unique_ptr<Kernel> make_smooth_block(std::unique_ptr<Kernel> kernel) {
  return std::make_unique<SmoothBlock>(std::move(kernel));
}

}  // namespace patina
