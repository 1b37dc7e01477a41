#include "engine/sampling/tempered_sample.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "engine/sampling/parallel_for.h"
#include "engine/sampling/sample_record.h"
#include "engine/sampling/tempering.h"

namespace patina {
namespace {

/// One chain's ladder.
struct Climber {
  TemperedState state;
  Rng rng;
  std::vector<ChainWarmup> warmups;  ///< of every rung but the prior's
  SwapRecord swaps;
};

/// What all climbers share.
struct Ladder {
  const LogDensity& target;
  const Kernel& kernel;
  std::vector<double> betas;
  std::vector<TemperedDensity> densities;  ///< of every rung but the prior's

  Ladder(const LogDensity& target, const Kernel& kernel, std::vector<double> betas)
      : target(target), kernel(kernel) {
    set(std::move(betas));
  }

  void set(std::vector<double> wanted) {
    betas = std::move(wanted);
    densities.clear();
    for (std::size_t rung = 1; rung < betas.size(); ++rung) densities.emplace_back(target, betas[rung]);
  }
};

/// One transition on rung i + 1. Its state stays, to the last bit, where nothing is accepted.
TransitionInfo step(const Ladder& ladder, std::size_t i, const KernelSettings& settings, Climber& climber) {
  ChainState& state = climber.state.rungs[i + 1];
  ChainState tempered = ladder.densities[i].tempered(state);
  const TransitionInfo info = ladder.kernel.step(ladder.densities[i], settings, tempered, climber.rng);
  if (info.accepted) state = ladder.densities[i].untempered(tempered);
  return info;
}

/// A draw of the prior to begin with, where there is a density.
ChainState start(const LogDensity& target, Rng& rng) {
  constexpr int kMostTries = 10000;
  for (int tries = 0; tries < kMostTries; ++tries) {
    ChainState state = prior_draw(target, rng);
    if (std::isfinite(state.evaluation.log_density)) return state;
  }
  throw std::invalid_argument("no draw of N(0, I) has a density");
}

Climber begin(const Ladder& ladder, const SampleSettings& settings, std::size_t index) {
  const LogDensity& target = ladder.target;
  Rng rng(settings.seed, index + 1);
  std::vector<ChainState> rungs;
  std::vector<ChainWarmup> warmups;
  const auto metric = std::make_shared<const Metric>(Metric::identity(target.dimension()));
  for (std::size_t rung = 0; rung < ladder.betas.size(); ++rung) {
    rungs.push_back(start(target, rng));
    if (rung == 0) continue;
    KernelSettings first{0.5, metric};
    const TemperedDensity& density = ladder.densities[rung - 1];
    if (settings.warmup > 0 && ladder.kernel.target_acceptance() > 0)
      first.step_size = initial_step_size(density, first, density.tempered(rungs.back()), rng);
    warmups.emplace_back(first, ladder.kernel.target_acceptance());
  }
  return {tempered_state(std::move(rungs)), rng, std::move(warmups), SwapRecord(ladder.betas.size())};
}

void warm_up_window(const Ladder& ladder, const WarmupWindow& window, Climber& climber) {
  for (int t = window.begin; t < window.end; ++t) {
    climber.state.rungs.front() = prior_draw(ladder.target, climber.rng);
    for (std::size_t i = 0; i < climber.warmups.size(); ++i) {
      ChainWarmup& warmup = climber.warmups[i];
      const TransitionInfo info = step(ladder, i, warmup.settings(), climber);
      warmup.observe(climber.state.rungs[i + 1], info);
    }
    swap_rungs(ladder.betas, climber.state, climber.swaps, climber.rng);
  }
}

std::vector<double> take_rejection(std::vector<Climber>& climbers, std::size_t rungs) {
  SwapRecord pooled(rungs);
  for (Climber& climber : climbers) pooled.add(std::exchange(climber.swaps, SwapRecord(rungs)));
  return pooled.rejection();
}

/// @return what each rung but the prior's goes on with
std::vector<KernelSettings> warm_up(Ladder& ladder, const SampleSettings& settings,
                                    std::vector<Climber>& climbers) {
  std::vector<KernelSettings> frozen;
  for (const ChainWarmup& warmup : climbers.front().warmups) frozen.push_back(warmup.settings());
  for (const WarmupWindow& window : warmup_schedule(settings.warmup)) {
    parallel_for(climbers.size(), settings.threads,
                 [&](std::size_t k) { warm_up_window(ladder, window, climbers[k]); });
    for (std::size_t i = 0; i < frozen.size(); ++i) {
      std::vector<WindowResult> results;
      for (Climber& climber : climbers) results.push_back(climber.warmups[i].take_window());
      const KernelSettings pooled =
          pool(results, settings.metric, settings.metric_worth, ladder.target.jagged());
      if (window.adapts_metric)
        for (Climber& climber : climbers) climber.warmups[i].restart(pooled);
      const KernelSettings& now = climbers.front().warmups[i].settings();
      frozen[i] = {pooled.step_size, now.metric, now.straightening};
    }
    const std::vector<double> rejection = take_rejection(climbers, ladder.betas.size());
    if (window.adapts_metric) ladder.set(equalised_ladder(ladder.betas, rejection));
  }
  return frozen;
}

SampleTally draw(const Ladder& ladder, const std::vector<KernelSettings>& frozen, Eigen::Index k,
                 Climber& climber, Sample& sample) {
  SampleTally tally;
  for (Eigen::Index t = 0; t < sample.energy.rows(); ++t) {
    climber.state.rungs.front() = prior_draw(ladder.target, climber.rng);
    ++tally.evaluations;
    TransitionInfo info;
    for (std::size_t i = 0; i < frozen.size(); ++i) {
      info = step(ladder, i, frozen[i], climber);
      if (i + 1 < frozen.size()) tally.evaluations += info.evaluations;
    }
    tally.add(info);
    swap_rungs(ladder.betas, climber.state, climber.swaps, climber.rng);
    record(sample, t, k, climber.state.rungs.back(), info.energy);
  }
  return tally;
}

}  // namespace

double TemperedSample::barrier() const {
  return std::accumulate(swap_rejection.begin(), swap_rejection.end(), 0.0);
}

TemperedSample sample_tempered(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
                               int rungs) {
  if (rungs < 2) throw std::invalid_argument("a ladder has at least two rungs");
  Ladder ladder(target, kernel, first_ladder(rungs));
  std::vector<Climber> climbers;
  for (int k = 0; k < settings.chains; ++k)
    climbers.push_back(begin(ladder, settings, static_cast<std::size_t>(k)));
  const std::vector<KernelSettings> frozen = warm_up(ladder, settings, climbers);

  TemperedSample tempered;
  Sample& sample = tempered.sample;
  sample.frozen = frozen.back();
  shape(sample, target, settings);
  for (Climber& climber : climbers) climber.state.round_trips = 0;
  std::vector<SampleTally> tallies(climbers.size());
  parallel_for(climbers.size(), settings.threads, [&](std::size_t k) {
    tallies[k] = draw(ladder, frozen, static_cast<Eigen::Index>(k), climbers[k], sample);
  });
  add_tallies(sample, tallies);
  for (const Climber& climber : climbers) tempered.round_trips.push_back(climber.state.round_trips);
  tempered.swap_rejection = take_rejection(climbers, ladder.betas.size());
  tempered.betas = ladder.betas;
  return tempered;
}

}  // namespace patina
