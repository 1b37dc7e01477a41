#include "engine/sampling/tempered_sample.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "engine/sampling/climber.h"
#include "engine/sampling/noise.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/sample_record.h"

namespace patina {
namespace {

struct OneChain {
  Climber climber;
  Rng rng;
};

/// A draw of the prior to begin with, where there is a density.
ChainState start(const LogDensity& target, Rng& rng) {
  constexpr int kMostTries = 10000;
  for (int tries = 0; tries < kMostTries; ++tries) {
    ChainState state = prior_state(target, rng);
    if (std::isfinite(state.evaluation.log_density)) return state;
  }
  throw std::invalid_argument("no draw of N(0, I) has a density");
}

OneChain begin(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings, int rungs,
               std::size_t index) {
  Rng rng(settings.seed, index + 1);
  const auto metric = std::make_shared<const Metric>(Metric::identity(target.dimension()));
  Climber climber = begin_climb(
      target, kernel, rungs, metric, settings.warmup > 0, [&](Rng& r) { return start(target, r); }, rng);
  return {std::move(climber), rng};
}

void warm_up(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
             std::vector<OneChain>& chains) {
  for (const WarmupWindow& window : warmup_schedule(settings.warmup)) {
    std::vector<LadderWindow> results(chains.size());
    parallel_for(chains.size(), settings.threads, [&](std::size_t k) {
      auto& [climber, rng] = chains[k];
      for (int t = window.begin; t < window.end; ++t)
        take_step(next_step(target, kernel, climber, rng), /*warmup=*/true, climber);
      results[k] = take_window(climber);
    });
    if (!chains_meet(window, settings.warmup)) continue;
    const LadderSettings agreed = pool(results, settings.metric, settings.metric_worth, target.jagged());
    for (OneChain& chain : chains) go_on_with(agreed, window.adapts_metric, chain.climber);
  }
}

SampleTally draw(const LogDensity& target, const Kernel& kernel, Eigen::Index k, OneChain& chain,
                 Sample& sample) {
  SampleTally tally;
  for (Eigen::Index t = 0; t < sample.energy.rows(); ++t) {
    ClimberStep step = next_step(target, kernel, chain.climber, chain.rng);
    tally.add(step.on_target);
    record(sample, t, k, step.state.rungs.back(), step.on_target);
    take_step(std::move(step), /*warmup=*/false, chain.climber);
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
  std::vector<OneChain> chains;
  for (int k = 0; k < settings.chains; ++k)
    chains.push_back(begin(target, kernel, settings, rungs, static_cast<std::size_t>(k)));
  warm_up(target, kernel, settings, chains);

  TemperedSample tempered;
  Sample& sample = tempered.sample;
  sample.frozen = chains.front().climber.target_settings();
  shape(sample, target, settings);
  sample.noise = value_noise(target, chains.front().climber.on_target().position, settings.noise_repeats);
  for (OneChain& chain : chains) chain.climber.state.round_trips = 0;
  std::vector<SampleTally> tallies(chains.size());
  parallel_for(chains.size(), settings.threads, [&](std::size_t k) {
    tallies[k] = draw(target, kernel, static_cast<Eigen::Index>(k), chains[k], sample);
  });
  add_tallies(sample, tallies);
  SwapRecord swaps(static_cast<std::size_t>(rungs));
  for (const auto& [climber, rng] : chains) {
    tempered.round_trips.push_back(climber.state.round_trips);
    swaps.add(climber.swaps);
  }
  tempered.swap_rejection = swaps.rejection();
  tempered.betas = chains.front().climber.betas;
  return tempered;
}

}  // namespace patina
