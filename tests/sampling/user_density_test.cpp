#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/warmup.h"

// What a user writes to sample a density of their own, from end to end; it knows nothing of materials.

namespace patina {
namespace {

/// Logistic growth of a population seen at eleven times with 10 % error: rate and capacity, both positive,
/// sampled as their logs x, with prior x ~ N((0, log 100), 1) in which the Jacobian of the logs is included.
class Growth final : public LogDensity {
 public:
  Eigen::Index dimension() const override { return 2; }

  Evaluation evaluate(const Position& position) const override {
    const double rate = std::exp(position.continuous[0]), capacity = std::exp(position.continuous[1]);
    const Eigen::Vector2d offset = position.continuous - Eigen::Vector2d(0, std::log(100.0));
    Evaluation result{-0.5 * offset.squaredNorm(), -offset};
    for (int t = 0; t <= 10; ++t) {
      // log population = log capacity - log(1 + (capacity / 2 - 1) e^(-rate t)), from 2 at t = 0
      const double decay = std::exp(-rate * t), rest = 1 + (capacity / 2 - 1) * decay;
      const double misfit = (kLogSeen[t] - (position.continuous[1] - std::log(rest))) / 0.1;
      result.log_density -= 0.5 * misfit * misfit;
      result.gradient[0] += misfit / 0.1 * (capacity / 2 - 1) * decay * rate * t / rest;
      result.gradient[1] += misfit / 0.1 * (1 - capacity / 2 * decay / rest);
    }
    return result;
  }

 private:
  static constexpr double kLogSeen[11] = {0.62, 1.49, 2.23, 3.03, 3.59, 4.10, 4.25, 4.49, 4.44, 4.66, 4.58};
};

struct Chain {
  ChainState state;
  ChainWarmup warmup;
  Rng rng;
};

std::vector<Chain> start_chains(const LogDensity& target, const Kernel& kernel, int count) {
  std::vector<Chain> chains;
  const auto metric = std::make_shared<const Metric>(Metric::identity(target.dimension()));
  for (int k = 0; k < count; ++k) {
    Rng rng(/*seed=*/1, /*stream=*/k);
    const Position start{Eigen::Vector2d(0, std::log(100.0)) + rng.normals(2), {}};
    chains.push_back({{start, target.evaluate(start)}, {{0.1, metric}, kernel.target_acceptance()}, rng});
  }
  return chains;
}

/// @return the settings to sample with, the same for all chains
KernelSettings warm_up(const LogDensity& target, const Kernel& kernel, int iterations,
                       std::vector<Chain>& chains) {
  KernelSettings frozen;
  for (const WarmupWindow& window : warmup_schedule(iterations)) {
    std::vector<WindowResult> seen;
    for (Chain& chain : chains) {
      for (int t = window.begin; t < window.end; ++t)
        chain.warmup.observe(chain.state,
                             kernel.step(target, chain.warmup.settings(), chain.state, chain.rng));
      seen.push_back(chain.warmup.take_window());
    }
    const KernelSettings pooled = pool(seen, MetricKind::dense);
    if (window.adapts_metric)
      for (Chain& chain : chains) chain.warmup.restart(pooled);
    frozen = {pooled.step_size, chains.front().warmup.settings().metric};
  }
  return frozen;
}

/// @return one matrix per coordinate, draws x chains
std::vector<Eigen::MatrixXd> sample(const LogDensity& target, const Kernel& kernel,
                                    const KernelSettings& frozen, int draws, std::vector<Chain>& chains) {
  std::vector<Eigen::MatrixXd> coordinates(target.dimension(), Eigen::MatrixXd(draws, chains.size()));
  for (std::size_t k = 0; k < chains.size(); ++k) {
    for (int t = 0; t < draws; ++t) {
      kernel.step(target, frozen, chains[k].state, chains[k].rng);
      for (Eigen::Index i = 0; i < target.dimension(); ++i)
        coordinates[i](t, k) = chains[k].state.position.continuous[i];
    }
  }
  return coordinates;
}

/// The posterior's mean by quadrature on a grid: a second route that needs neither gradient nor chain.
Eigen::Vector2d mean_by_quadrature(const LogDensity& target) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double total = 0;
  for (double x = -1.5; x < 1; x += 0.005)
    for (double y = 3.5; y < 6; y += 0.005) {
      const Eigen::Vector2d point(x, y);
      const double weight = std::exp(target.evaluate({point, {}}).log_density);
      sum += weight * point;
      total += weight;
    }
  return sum / total;
}

TEST(UserDensity, is_sampled_from_end_to_end_and_agrees_with_quadrature) {
  const Growth target;
  const auto kernel = make_kernel("mala", target, 1);
  std::vector<Chain> chains = start_chains(target, *kernel, 4);
  const KernelSettings frozen = warm_up(target, *kernel, 500, chains);
  const std::vector<Eigen::MatrixXd> draws = sample(target, *kernel, frozen, 1500, chains);
  const Eigen::Vector2d expected = mean_by_quadrature(target);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_LT(split_rhat(draws[i]), 1.01);
    EXPECT_GT(bulk_ess(draws[i]), 400);
    EXPECT_GT(tail_ess(draws[i]), 400);
    EXPECT_LT(std::abs(draws[i].mean() - expected[i]), 5 * mcse_mean(draws[i]));
  }
}

TEST(UserDensity, gradient_is_that_of_its_value) {
  const Growth target;
  const Eigen::Vector2d x(-0.2, 4.6);
  const Evaluation at_x = target.evaluate({x, {}});
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = 1e-5 * Eigen::Vector2d::Unit(i);
    const double slope =
        (target.evaluate({x + step, {}}).log_density - target.evaluate({x - step, {}}).log_density) / 2e-5;
    EXPECT_NEAR(at_x.gradient[i], slope, 1e-5 * (1 + std::abs(slope)));
  }
}

}  // namespace
}  // namespace patina
