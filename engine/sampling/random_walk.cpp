#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

// Roberts, Gelman & Gilks 1997: the optimum as the dimension grows.
constexpr double kUsualAcceptance = 0.234;

TransitionInfo walk(const LogDensity& target, const Metric& metric, double step_size, MoveKind move,
                    ChainState& state, Rng& rng) {
  assert(metric.dimension() == state.position.continuous.size());
  ChainState proposal{state.position, {}};
  Eigen::VectorXd& x = proposal.position.continuous;
  x += step_size * metric.colour(rng.normals(x.size()));
  proposal.evaluation = value_finite(target, proposal.position);
  const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density;
  return metropolis_step(move, log_ratio, kNeverDivergent, std::move(proposal), state, rng);
}

class RandomWalk final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    assert(settings.metric);
    return walk(target, *settings.metric, settings.step_size, MoveKind::continuous, state, rng);
  }
  double target_acceptance() const override { return kUsualAcceptance; }
};

class WalkOfAllScales final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    constexpr double kLargest = 0.5, kSmallestShare = 0.04;
    assert(settings.metric);
    const double step_size = kLargest * std::pow(kSmallestShare, rng.uniform());
    return walk(target, *settings.metric, step_size, MoveKind::refresh, state, rng);
  }
  double target_acceptance() const override { return kUsualAcceptance; }
};

}  // namespace

std::unique_ptr<Kernel> make_random_walk() { return std::make_unique<RandomWalk>(); }

std::unique_ptr<Kernel> make_walk_of_all_scales() { return std::make_unique<WalkOfAllScales>(); }

}  // namespace patina
