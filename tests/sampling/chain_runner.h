#pragma once

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "engine/sampling/kernel.h"
#include "engine/sampling/warmup.h"

namespace patina {

/// What several chains drew, one after the other on this thread, as a run's threads would.
struct ChainsDrawn {
  std::vector<Eigen::MatrixXd> coordinates;  ///< one matrix a continuous coordinate, draws x chains
  Eigen::MatrixXd energy;                    ///< draws x chains
  std::vector<double> acceptance;            ///< of each chain, over its continuous moves
  std::vector<double> step_sizes;            ///< frozen
  int divergences = 0;
  long evaluations = 0;  ///< after warm-up
};

struct RunPlan {
  int chains = 4, warmup = 1000, draws = 1000;
  MetricKind metric = MetricKind::dense;
  std::uint64_t seed = 1;
  double metric_worth = 0;  ///< of the metric that warm-up begins with, see pool()
};

class ChainRunner {
 public:
  using Start = std::function<Eigen::VectorXd(Rng&)>;

  /// @param metric  to begin warm-up with
  ChainRunner(const LogDensity& target, const Kernel& kernel, const RunPlan& plan, const Start& start,
              const Metric& metric)
      : target_(target), kernel_(kernel), plan_(plan) {
    for (int k = 0; k < plan.chains; ++k) {
      Rng rng(plan.seed, static_cast<std::uint64_t>(k) + 1);
      const Position position{
          start(rng), Eigen::VectorXi::Zero(static_cast<Eigen::Index>(target.discrete_levels().size()))};
      const ChainState state{position, target.evaluate(position)};
      KernelSettings settings{0.5, std::make_shared<const Metric>(metric)};
      settings.step_size = initial_step_size(target, settings, state, rng);
      chains_.push_back({state, ChainWarmup(settings, kernel.target_acceptance()), rng, settings});
    }
  }

  ChainsDrawn run() {
    warm_up();
    ChainsDrawn drawn;
    drawn.coordinates.assign(target_.dimension(), Eigen::MatrixXd(plan_.draws, plan_.chains));
    drawn.energy.resize(plan_.draws, plan_.chains);
    for (int k = 0; k < plan_.chains; ++k) sample(k, drawn);
    return drawn;
  }

 private:
  struct OneChain {
    ChainState state;
    ChainWarmup warmup;
    Rng rng;
    KernelSettings frozen;
  };

  void warm_up() {
    for (const WarmupWindow& window : warmup_schedule(plan_.warmup)) {
      std::vector<WindowResult> results;
      for (OneChain& chain : chains_) {
        for (int t = window.begin; t < window.end; ++t)
          chain.warmup.observe(chain.state,
                               kernel_.step(target_, chain.warmup.settings(), chain.state, chain.rng));
        results.push_back(chain.warmup.take_window());
      }
      const KernelSettings pooled = pool(results, plan_.metric, plan_.metric_worth);
      for (OneChain& chain : chains_) {
        if (window.adapts_metric) chain.warmup.restart(pooled);
        chain.frozen = {pooled.step_size, chain.warmup.settings().metric};
      }
    }
  }

  void sample(int k, ChainsDrawn& drawn) {
    OneChain& chain = chains_[k];
    double accepted = 0;
    int continuous = 0;
    for (int t = 0; t < plan_.draws; ++t) {
      const TransitionInfo info = kernel_.step(target_, chain.frozen, chain.state, chain.rng);
      if (info.move == MoveKind::continuous) accepted += info.accept_probability, ++continuous;
      drawn.divergences += info.divergent;
      drawn.evaluations += info.evaluations;
      drawn.energy(t, k) = info.energy;
      for (Eigen::Index i = 0; i < target_.dimension(); ++i)
        drawn.coordinates[i](t, k) = chain.state.position.continuous[i];
    }
    drawn.acceptance.push_back(accepted / continuous);
    drawn.step_sizes.push_back(chain.frozen.step_size);
  }

  const LogDensity& target_;
  const Kernel& kernel_;
  RunPlan plan_;
  std::vector<OneChain> chains_;
};

}  // namespace patina
