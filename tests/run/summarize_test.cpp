#include "engine/run/summarize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/diagnostics/convergence.h"

namespace patina {
namespace {

ParameterTable wide_and_narrow() {
  ParameterTable table;
  table.material = "small";
  table.continuous = {{"wide", "", "", {0, 1, -100, 100}}, {"narrow", "", "", {0, 1, -100, 100}}};
  table.discrete = {{"choice", "", {"a", "b", "c"}}};
  return table;
}

/// Independent draws: wide ~ N(1, 1), narrow ~ N(-2, 0.1^2), choice uniform.
std::vector<Draw> random_draws(int chains, int per_chain, int warmup) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  std::vector<Draw> draws;
  for (int k = 0; k < chains; ++k)
    for (int i = 0; i < warmup + per_chain; ++i) {
      Draw draw;
      draw.chain = k;
      draw.iteration = i;
      draw.warmup = i < warmup;
      draw.lp = draw.warmup ? -1e9 : -std::abs(normal(generator));
      draw.accept_stat = 0.25 * (k + 1);
      draw.divergent = i == warmup + 1;
      draw.values = {{1 + normal(generator), -2 + 0.1 * normal(generator)},
                     {static_cast<int>(generator() % 3)}};
      draws.push_back(draw);
    }
  return draws;
}

TEST(SummarizeDraws, AgreesWithMomentsAndDiagnosticsComputedDirectly) {
  constexpr int kChains = 3, kDraws = 500;
  const std::vector<Draw> draws = random_draws(kChains, kDraws, 100);
  Eigen::MatrixXd wide(kDraws, kChains);
  for (const Draw& draw : draws)
    if (!draw.warmup) wide(draw.iteration - 100, draw.chain) = draw.values.continuous[0];
  const RunSummary summary = summarize_draws(wide_and_narrow(), draws);
  ASSERT_EQ(summary.quantities.size(), 4u);
  const QuantitySummary& q = summary.quantities[1];
  EXPECT_EQ(q.name, "wide");
  EXPECT_NEAR(q.mean, wide.mean(), 1e-12);
  EXPECT_NEAR(q.sd * q.sd, (wide.array() - wide.mean()).square().sum() / (wide.size() - 1), 1e-12);
  std::vector<double> sorted(wide.data(), wide.data() + wide.size());
  std::ranges::sort(sorted);
  EXPECT_NEAR(q.q50, 0.5 * (sorted[749] + sorted[750]), 1e-12);
  EXPECT_LT(q.q5, q.q25);
  EXPECT_LT(q.q75, q.q95);
  EXPECT_EQ(q.rhat, split_rhat(wide));
  EXPECT_EQ(q.bulk_ess, bulk_ess(wide));
  EXPECT_EQ(q.tail_ess, tail_ess(wide));
  EXPECT_EQ(q.mcse_mean, mcse_mean(wide));
  EXPECT_NEAR(q.sd_over_prior_sd, q.sd, 1e-9);  // the prior's bounds are far away
  EXPECT_NEAR(summary.quantities[2].sd_over_prior_sd, 0.1, 0.01);
  EXPECT_NEAR(summary.quantities[3].mean, 1, 0.1);
  EXPECT_TRUE(std::isnan(summary.quantities[3].sd_over_prior_sd));
  EXPECT_TRUE(std::isnan(summary.quantities[0].sd_over_prior_sd));
}

TEST(SummarizeDraws, LeavesWarmUpOut) {
  std::vector<Draw> draws = random_draws(2, 100, 50), sampled;
  std::ranges::copy_if(draws, std::back_inserter(sampled), [](const Draw& d) { return !d.warmup; });
  const RunSummary with = summarize_draws(wide_and_narrow(), draws),
                   without = summarize_draws(wide_and_narrow(), sampled);
  for (std::size_t i = 0; i < with.quantities.size(); ++i) {
    EXPECT_EQ(with.quantities[i].mean, without.quantities[i].mean);
    EXPECT_EQ(with.quantities[i].rhat, without.quantities[i].rhat);
  }
}

TEST(SummarizeDraws, CountsEachChain) {
  const RunSummary summary = summarize_draws(wide_and_narrow(), random_draws(2, 100, 10));
  ASSERT_EQ(summary.chains.size(), 2u);
  EXPECT_EQ(summary.chains[1].chain, 1);
  EXPECT_EQ(summary.chains[1].draws, 100);
  EXPECT_DOUBLE_EQ(summary.chains[1].acceptance, 0.5);
  EXPECT_EQ(summary.chains[1].divergences, 1);
  EXPECT_NEAR(summary.chains[1].ebfmi, 2, 0.6);  // of independent energies
}

TEST(SummarizeDraws, EnergyFractionIsOfTheTrajectoriesWhereThereAreAny) {
  std::vector<Draw> draws = random_draws(1, 400, 0);
  Eigen::VectorXd energy(200);
  for (std::size_t i = 0; i < draws.size(); ++i) {
    draws[i].energy = -draws[i].lp;  // of a move without a momentum
    if (i % 2 == 1) draws[i].energy += 0.1 * static_cast<double>(i);
    if (i % 2 == 1) energy[static_cast<Eigen::Index>(i / 2)] = draws[i].energy;
  }
  EXPECT_DOUBLE_EQ(summarize_draws(wide_and_narrow(), draws).chains[0].ebfmi, ebfmi(energy));
  EXPECT_LT(ebfmi(energy), 0.3);
}

TEST(SummarizeDraws, CutsChainsToTheShortestThatHasDraws) {
  std::vector<Draw> draws = random_draws(3, 100, 0);
  std::erase_if(draws, [](const Draw& d) { return d.chain == 0 || (d.chain == 2 && d.iteration >= 40); });
  Eigen::MatrixXd narrow(40, 2);
  for (const Draw& draw : draws)
    if (draw.iteration < 40) narrow(draw.iteration, draw.chain - 1) = draw.values.continuous[1];
  EXPECT_NEAR(summarize_draws(wide_and_narrow(), draws).quantities[2].mean, narrow.mean(), 1e-12);
}

TEST(SummarizeDraws, OfNothingHasNoNumbers) {
  const RunSummary summary = summarize_draws(wide_and_narrow(), {});
  EXPECT_TRUE(summary.chains.empty());
  ASSERT_EQ(summary.quantities.size(), 4u);
  EXPECT_TRUE(std::isnan(summary.quantities[0].mean));
  EXPECT_TRUE(std::isnan(summary.quantities[0].rhat));
}

TEST(SummarizeDraws, AFixedParameterHasNoSpread) {
  std::vector<Draw> draws = random_draws(2, 50, 0);
  for (Draw& draw : draws) draw.values.continuous[0] = 0.5;
  const QuantitySummary fixed = summarize_draws(wide_and_narrow(), draws).quantities[1];
  EXPECT_EQ(fixed.mean, 0.5);
  EXPECT_EQ(fixed.sd, 0);
  EXPECT_TRUE(std::isnan(fixed.rhat));
}

}  // namespace
}  // namespace patina
