#include "engine/run/running_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patina {
namespace {

ParameterTable slow_and_fast() {
  ParameterTable table;
  table.material = "small";
  table.continuous = {{"slow", "", "", {0, 1, -100, 100}}, {"fast", "", "", {0, 1, -100, 100}}};
  table.discrete = {{"choice", "", {"a", "b", "c"}}};
  return table;
}

/// Chains in turn: slow an autoregression of correlation 0.9, fast and choice independent; warm-up elsewhere.
std::vector<Draw> chains_of(int chains, int per_chain, int warmup) {
  std::mt19937 generator(6);
  std::normal_distribution<double> normal;
  std::vector<double> slow(static_cast<std::size_t>(chains));
  std::vector<Draw> draws;
  for (int i = 0; i < warmup + per_chain; ++i)
    for (int k = 0; k < chains; ++k) {
      double& x = slow[static_cast<std::size_t>(k)];
      x = 0.9 * x + std::sqrt(1 - 0.81) * normal(generator);
      Draw draw;
      draw.chain = k;
      draw.iteration = i;
      draw.warmup = i < warmup;
      draw.lp = draw.warmup ? -1e9 : -0.5 * x * x;
      draw.accept_stat = 0.2 * (k + 1);
      draw.divergent = i % 100 == k;
      draw.values = {{x, 5 + 0.1 * normal(generator)}, {static_cast<int>(generator() % 3)}};
      draws.push_back(draw);
    }
  return draws;
}

TEST(RunningSummary, BringsTheSummaryOfAFewDrawsToThatOfAll) {
  const std::vector<Draw> draws = chains_of(4, 12000, 50);
  RunningSummary running(slow_and_fast());
  std::vector<Draw> few;
  for (const Draw& draw : draws) {
    running.add(draw);
    if (draw.iteration % 8 == 0) few.push_back(draw);
  }
  const RunSummary exact = summarize_draws(slow_and_fast(), draws),
                   of_few = summarize_draws(slow_and_fast(), few);
  RunSummary summary = of_few;
  for (int times = 0; times < 2; ++times) running.update(summary);
  ASSERT_EQ(summary.quantities.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const QuantitySummary &cheap = summary.quantities[i], &full = exact.quantities[i];
    EXPECT_NEAR(cheap.mean, full.mean, 1e-12 * (1 + std::abs(full.mean))) << cheap.name;
    EXPECT_NEAR(cheap.sd / full.sd, 1, 1e-10) << cheap.name;
    EXPECT_NEAR(cheap.rhat, full.rhat, 0.002) << cheap.name;
    EXPECT_NEAR(cheap.bulk_ess / full.bulk_ess, 1, 0.2) << cheap.name;
    EXPECT_NEAR(cheap.tail_ess / full.tail_ess, 1, 0.2) << cheap.name;
    EXPECT_NEAR(cheap.mcse_mean / full.mcse_mean, 1, 0.1) << cheap.name;
    ASSERT_EQ(cheap.chain_means.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(cheap.chain_means[k].mean, full.chain_means[k].mean, 1e-12);
    EXPECT_EQ(cheap.q50, of_few.quantities[i].q50);
  }
  EXPECT_NEAR(summary.quantities[1].sd_over_prior_sd, exact.quantities[1].sd_over_prior_sd, 1e-10);
  EXPECT_LT(of_few.quantities[2].bulk_ess, 0.3 * exact.quantities[2].bulk_ess)
      << "few are not all: or this shows nothing";
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(summary.chains[k].draws, 12000);
    EXPECT_EQ(summary.chains[k].divergences, exact.chains[k].divergences);
    EXPECT_NEAR(summary.chains[k].acceptance, exact.chains[k].acceptance, 1e-12);
  }
}

}  // namespace
}  // namespace patina
