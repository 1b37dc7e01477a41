#include "engine/sampling/sample.h"

#include <memory>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/parallel_for.h"
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

/// @return what all chains go on with
KernelSettings warm_up(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
                       std::vector<OneChain>& chains) {
  KernelSettings frozen = chains.front().warmup.settings();
  for (const WarmupWindow& window : warmup_schedule(settings.warmup)) {
    std::vector<WindowResult> results(chains.size());
    parallel_for(chains.size(), settings.threads, [&](std::size_t k) {
      OneChain& chain = chains[k];
      for (int t = window.begin; t < window.end; ++t)
        chain.warmup.observe(chain.state,
                             kernel.step(target, chain.warmup.settings(), chain.state, chain.rng));
      results[k] = chain.warmup.take_window();
    });
    const KernelSettings pooled = pool(results, settings.metric, settings.metric_worth, target.jagged());
    if (window.adapts_metric)
      for (OneChain& chain : chains) chain.warmup.restart(pooled);
    const KernelSettings& now = chains.front().warmup.settings();
    frozen = {pooled.step_size, now.metric, now.straightening};
  }
  return frozen;
}

SampleTally draw(const LogDensity& target, const Kernel& kernel, Eigen::Index k, OneChain& chain,
                 Sample& sample) {
  SampleTally tally;
  for (Eigen::Index t = 0; t < sample.energy.rows(); ++t) {
    const TransitionInfo info = kernel.step(target, sample.frozen, chain.state, chain.rng);
    tally.add(info);
    record(sample, t, k, chain.state, info.energy);
  }
  return tally;
}

}  // namespace

Sample sample(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
              const Start& start, const Metric& metric) {
  const auto shared_metric = std::make_shared<const Metric>(metric);
  std::vector<OneChain> chains;
  for (int k = 0; k < settings.chains; ++k)
    chains.push_back(begin(target, kernel, settings, k, start, shared_metric));
  Sample sample;
  sample.frozen = warm_up(target, kernel, settings, chains);
  shape(sample, target, settings);
  std::vector<SampleTally> tallies(chains.size());
  parallel_for(chains.size(), settings.threads, [&](std::size_t k) {
    tallies[k] = draw(target, kernel, static_cast<Eigen::Index>(k), chains[k], sample);
  });
  add_tallies(sample, tallies);
  return sample;
}

Sample sample(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings) {
  const std::vector<int> levels = target.discrete_levels();
  const auto start = [&](Rng& rng) {
    Position position{rng.normals(target.dimension()), Eigen::VectorXi(std::ssize(levels))};
    for (std::size_t i = 0; i < levels.size(); ++i)
      position.discrete[static_cast<Eigen::Index>(i)] = rng.below(levels[i]);
    return position;
  };
  return sample(target, kernel, settings, start, Metric::identity(target.dimension()));
}

}  // namespace patina
