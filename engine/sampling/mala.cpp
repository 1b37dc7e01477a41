#include "engine/sampling/mala.h"

#include <cassert>
#include <memory>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

constexpr double kDivergentFall = 1000;  // as in Stan

class Mala final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    return with_gradient(target, state, [&] { return move(target, settings, state, rng); });
  }

  /// Roberts & Rosenthal 1998: the optimum of MALA as the dimension grows.
  double target_acceptance() const override { return 0.574; }

 private:
  TransitionInfo move(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const {
    assert(settings.metric && settings.metric->dimension() == state.position.continuous.size());
    ChainState proposal{propose(settings, state, rng), {}};
    proposal.evaluation = evaluate_finite(target, proposal.position);
    const double log_ratio = mala_log_ratio(settings, state, proposal);
    return metropolis_step(MoveKind::continuous, log_ratio, kDivergentFall, std::move(proposal), state, rng);
  }

  static Position propose(const KernelSettings& settings, const ChainState& state, Rng& rng) {
    const double step = settings.step_size;
    const Eigen::VectorXd noise = rng.normals(state.position.continuous.size());
    Position position = state.position;
    position.continuous += step * step / 2 * settings.metric->multiply(state.evaluation.gradient) +
                           step * settings.metric->colour(noise);
    return position;
  }
};

}  // namespace

double mala_log_ratio(const KernelSettings& settings, const ChainState& from, const ChainState& to) {
  const Metric& metric = *settings.metric;
  const Eigen::VectorXd& before = from.evaluation.gradient;
  const Eigen::VectorXd& after = to.evaluation.gradient;
  const double drift = (to.position.continuous - from.position.continuous).dot(before + after) / 2;
  const double curvature = after.dot(metric.multiply(after)) - before.dot(metric.multiply(before));
  return to.evaluation.log_density - from.evaluation.log_density - drift -
         settings.step_size * settings.step_size / 8 * curvature;
}

std::unique_ptr<Kernel> make_mala() { return std::make_unique<Mala>(); }

}  // namespace patina
