#include "engine/sampling/climber.h"

#include <utility>

#include "engine/sampling/prior_draw.h"

namespace patina {
namespace {

/// The number of rungs below those that the kernel moves.
std::size_t prior_rungs(const std::vector<double>& betas) { return betas.size() > 1; }

/// One transition of the kernel on a rung. Its state stays, to the last bit, where nothing is accepted; a
/// gradient that was missing is kept.
TransitionInfo step_rung(const LogDensity& target, const Kernel& kernel, double beta,
                         const KernelSettings& settings, ChainState& state, Rng& rng) {
  if (beta == 1) return kernel.step(target, settings, state, rng);
  const TemperedDensity density(target, beta);
  ChainState tempered = density.tempered(state);
  const TransitionInfo info = kernel.step(density, settings, tempered, rng);
  if (info.accepted)
    state = density.untempered(tempered);
  else if (state.evaluation.gradient.size() == 0)
    state.evaluation.gradient = density.untempered(tempered).evaluation.gradient;
  return info;
}

double first_step_size(const LogDensity& target, double beta, const KernelSettings& settings,
                       const ChainState& state, Rng& rng) {
  if (beta == 1) return initial_step_size(target, settings, state, rng);
  const TemperedDensity density(target, beta);
  return initial_step_size(density, settings, density.tempered(state), rng);
}

}  // namespace

Climber begin_climb(const LogDensity& target, const Kernel& kernel, int rungs,
                    const std::shared_ptr<const Metric>& metric, bool warms_up,
                    const std::function<ChainState(Rng&)>& start, Rng& rng) {
  Climber climber;
  if (rungs > 1) climber.betas = first_ladder(rungs);
  climber.swaps = SwapRecord(climber.betas.size());
  std::vector<ChainState> states;
  if (prior_rungs(climber.betas) > 0) states.push_back(prior_state(target, rng));
  for (std::size_t i = states.size(); i < climber.betas.size(); ++i) {
    const double beta = climber.betas[i];
    states.push_back(start(rng));
    KernelSettings first{0.5, tempered_metric(metric, beta)};
    if (warms_up && kernel.target_acceptance() > 0)
      first.step_size = first_step_size(target, beta, first, states.back(), rng);
    climber.warmups.emplace_back(first, kernel.target_acceptance());
  }
  climber.state = tempered_state(std::move(states));
  return climber;
}

ClimberStep next_step(const LogDensity& target, const Kernel& kernel, const Climber& climber, Rng& rng) {
  ClimberStep step{climber.state, climber.swaps, {}, {}};
  std::vector<ChainState>& states = step.state.rungs;
  const std::size_t first = prior_rungs(climber.betas);
  if (first > 0) states.front() = prior_state(target, rng);
  auto evaluations = static_cast<int>(first);
  for (std::size_t i = first; i < states.size(); ++i) {
    const KernelSettings& settings = climber.warmups[i - first].settings();
    step.rungs.push_back(step_rung(target, kernel, climber.betas[i], settings, states[i], rng));
    evaluations += step.rungs.back().evaluations;
  }
  step.on_target = step.rungs.back();
  step.on_target.evaluations = evaluations;
  if (first == 0) return step;
  const int before = step.state.traveller.back();
  swap_rungs(climber.betas, step.state, step.swaps, rng);
  if (step.state.traveller.back() != before) step.on_target.energy = -states.back().evaluation.log_density;
  return step;
}

void take_step(ClimberStep step, bool warmup, Climber& climber) {
  climber.state = std::move(step.state);
  climber.swaps = std::move(step.swaps);
  if (!warmup) return;
  const std::size_t first = prior_rungs(climber.betas);
  for (std::size_t i = 0; i < climber.warmups.size(); ++i)
    climber.warmups[i].observe(climber.state.rungs[first + i], step.rungs[i]);
}

LadderWindow take_window(Climber& climber) {
  LadderWindow window{climber.betas, {}, std::exchange(climber.swaps, SwapRecord(climber.betas.size()))};
  for (ChainWarmup& warmup : climber.warmups) window.rungs.push_back(warmup.take_window());
  return window;
}

void go_on_with(const LadderSettings& agreed, bool adapts_metric, Climber& climber) {
  if (adapts_metric) climber.betas = agreed.betas;
  for (std::size_t i = 0; i < climber.warmups.size(); ++i)
    if (adapts_metric)
      climber.warmups[i].restart(agreed.rungs[i]);
    else
      climber.warmups[i].freeze(agreed.rungs[i].step_size);
}

}  // namespace patina
