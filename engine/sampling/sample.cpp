#include "engine/sampling/sample.h"

#include <memory>
#include <optional>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/noise.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/sample_record.h"

namespace patina {
namespace {

struct OneChain {
  ChainState state;
  Rng rng;
  ChainWarmup warmup;
};

OneChain begin(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings, int index,
               const Start& start, const std::shared_ptr<const Metric>& metric) {
  Rng rng(settings.seed, static_cast<std::uint64_t>(index) + 1);
  Position position = start(rng);
  Evaluation evaluation = evaluate_finite(target, position);
  ChainState state{std::move(position), std::move(evaluation)};
  KernelSettings first{0.5, metric};
  if (settings.warmup > 0 && kernel.target_acceptance() > 0)
    first.step_size = initial_step_size(target, first, state, rng);
  return {std::move(state), rng, ChainWarmup(first, kernel.target_acceptance())};
}

std::vector<OneChain> begin_all(const LogDensity& target, const Kernel& kernel,
                                const SampleSettings& settings, const Start& start, const Metric& metric) {
  const auto shared_metric = std::make_shared<const Metric>(metric);
  std::vector<std::optional<OneChain>> begun(static_cast<std::size_t>(settings.chains));
  const auto begin_one = [&](std::size_t k) {
    begun[k] = begin(target, kernel, settings, static_cast<int>(k), start, shared_metric);
  };
  parallel_for(begun.size(), settings.threads, begin_one, settings.enter_thread);
  std::vector<OneChain> chains;
  for (std::optional<OneChain>& chain : begun) chains.push_back(std::move(*chain));
  return chains;
}

/// @return what all chains go on with
KernelSettings warm_up(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
                       std::vector<OneChain>& chains) {
  KernelSettings frozen = chains.front().warmup.settings();
  for (const WarmupWindow& window : warmup_schedule(settings.warmup)) {
    std::vector<WindowResult> results(chains.size());
    const auto run_window = [&](std::size_t k) {
      OneChain& chain = chains[k];
      for (int t = window.begin; t < window.end; ++t) {
        chain.warmup.observe(chain.state,
                             kernel.step(target, chain.warmup.settings(), chain.state, chain.rng));
        if (settings.warmed) settings.warmed(static_cast<int>(k), chain.state);
      }
      results[k] = chain.warmup.take_window();
    };
    parallel_for(chains.size(), settings.threads, run_window, settings.enter_thread);
    const KernelSettings pooled = pool(results, settings.metric, settings.metric_worth, target.jagged());
    if (window.adapts_metric)
      for (OneChain& chain : chains) chain.warmup.restart(pooled);
    const KernelSettings& now = chains.front().warmup.settings();
    frozen = {pooled.step_size, now.metric, now.straightening};
  }
  return frozen;
}

SampleTally draw(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
                 Eigen::Index k, OneChain& chain, Sample& sample) {
  SampleTally tally;
  for (Eigen::Index t = 0; t < sample.energy.rows(); ++t) {
    const TransitionInfo info = kernel.step(target, sample.frozen, chain.state, chain.rng);
    tally.add(info);
    record(sample, t, k, chain.state, info);
    if (settings.drew) settings.drew(static_cast<int>(k), chain.state);
  }
  return tally;
}

}  // namespace

Sample sample(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
              const Start& start, const Metric& metric) {
  std::vector<OneChain> chains = begin_all(target, kernel, settings, start, metric);
  Sample sample;
  sample.frozen = warm_up(target, kernel, settings, chains);
  const Kernel& of_draws = settings.kernel_of_draws ? settings.kernel_of_draws() : kernel;
  if (settings.warmed_up) settings.warmed_up(sample.frozen);
  sample.noise = value_noise(target, chains.front().state.position, settings.noise_repeats, settings.threads,
                             settings.enter_thread);
  shape(sample, target, settings);
  std::vector<SampleTally> tallies(chains.size());
  const auto draw_chain = [&](std::size_t k) {
    tallies[k] = draw(target, of_draws, settings, static_cast<Eigen::Index>(k), chains[k], sample);
  };
  parallel_for(chains.size(), settings.threads, draw_chain, settings.enter_thread);
  add_tallies(sample, tallies);
  return sample;
}

Sample sample(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings) {
  const auto start = [&](Rng& rng) { return prior_draw(target, rng); };
  return sample(target, kernel, settings, start, Metric::identity(target.dimension()));
}

}  // namespace patina
