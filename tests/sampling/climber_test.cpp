#include "engine/sampling/climber.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/sampling/kernels.h"
#include "tests/sampling/seen_with_an_error.h"

namespace patina {
namespace {

/// On exact draws of every rung of a ladder.
Climber exact_climber(const LogDensity& target, const std::vector<double>& betas, double step_size,
                      Rng& rng) {
  Climber climber;
  climber.betas = betas;
  climber.swaps = SwapRecord(betas.size());
  std::vector<ChainState> states;
  for (const double beta : betas) states.push_back(exact_draw(target, beta, rng));
  climber.state = tempered_state(std::move(states));
  for (std::size_t i = 1; i < betas.size(); ++i)
    climber.warmups.emplace_back(
        settings_with(step_size, std::pow(sd_at(betas[i]), 2) * Eigen::Matrix2d::Identity()), 0.8);
  return climber;
}

/// worst_distance() after a step on a ladder, from exact draws of the rungs of another.
double distance_after_a_step(const std::vector<double>& drawn_from, const std::vector<double>& betas) {
  const FunctionDensity target = seen_with_an_error();
  const auto kernel = make_hmc();
  std::vector<std::vector<double>> ends(2 * betas.size());
  Rng rng(203);
  for (int repeat = 0; repeat < 20000; ++repeat) {
    Climber climber = exact_climber(target, drawn_from, 0.7, rng);
    climber.betas = betas;
    climber.state.rounds = repeat;  // swaps of even and odd pairs
    take_step(next_step(target, *kernel, climber, rng), /*warmup=*/false, climber);
    for (std::size_t i = 0; i < ends.size(); ++i)
      ends[i].push_back(climber.state.rungs[i / 2].position.continuous[static_cast<Eigen::Index>(i % 2)]);
  }
  return worst_distance(betas, ends);
}

TEST(Climber, keeps_exact_draws_of_every_rung_exact) {
  EXPECT_LT(distance_after_a_step({0, 0.05, 0.3, 1}, {0, 0.05, 0.3, 1}), 1);
}

TEST(Climber, does_not_make_exact_draws_of_one_ladder_those_of_another) {
  EXPECT_GT(distance_after_a_step({0, 0.02, 0.1, 1}, {0, 0.05, 0.3, 1}), 1);
}

/// Leaves its gradient out where nobody asks for it, and counts.
class Lazy final : public LogDensity {
 public:
  Eigen::Index dimension() const override { return 2; }
  Evaluation evaluate(const Position& p) const override {
    ++evaluations;
    return target_.evaluate(p);
  }
  Evaluation value(const Position& p) const override {
    ++evaluations;
    return {target_.evaluate(p).log_density, {}};
  }

  mutable int evaluations = 0;

 private:
  FunctionDensity target_ = seen_with_an_error();
};

TEST(Climber, keeps_a_gradient_that_was_made_for_a_move_that_is_rejected) {
  const Lazy target;
  Rng rng(204);
  Climber climber = exact_climber(target, {0, 0.3, 1}, /*step_size=*/100, rng);
  climber.state.rounds = 1;  // the prior's draw is not swapped in
  for (ChainState& state : climber.state.rungs) state.evaluation.gradient.resize(0);
  const auto kernel = make_mala();
  const ClimberStep step = next_step(target, *kernel, climber, rng);
  for (const TransitionInfo& info : step.rungs) EXPECT_FALSE(info.accepted) << "or this shows nothing";
  for (std::size_t i = 1; i < 3; ++i) {
    const ChainState& state = step.state.rungs[i];
    const Eigen::VectorXd expected = target.evaluate(state.position).gradient;
    ASSERT_EQ(state.evaluation.gradient.size(), 2);
    EXPECT_TRUE(state.evaluation.gradient.isApprox(expected, 1e-10));
  }
}

TEST(Climber, counts_the_evaluations_of_all_rungs_and_has_the_energy_of_the_draw) {
  const Lazy target;
  Rng rng(205);
  Climber climber = exact_climber(target, {0, 0.1, 0.4, 1}, 0.7, rng);
  const auto kernel = make_nuts();
  int swapped = 0;
  for (int t = 0; t < 200; ++t) {
    const int before = target.evaluations, traveller = climber.state.traveller.back();
    ClimberStep step = next_step(target, *kernel, climber, rng);
    EXPECT_EQ(step.on_target.evaluations, target.evaluations - before);
    if (step.state.traveller.back() != traveller) {
      EXPECT_EQ(step.on_target.energy, -step.state.rungs.back().evaluation.log_density);
      ++swapped;
    } else {
      EXPECT_GT(step.on_target.energy, -step.state.rungs.back().evaluation.log_density);
    }
    take_step(std::move(step), /*warmup=*/false, climber);
  }
  EXPECT_GT(swapped, 10);
}

TEST(Climber, alone_on_its_ladder_is_the_kernel_by_itself) {
  const FunctionDensity target = seen_with_an_error();
  const auto kernel = make_hmc();
  const auto metric = std::make_shared<const Metric>(0.1 * Eigen::Matrix2d::Identity());
  Rng rng(206), same(206);
  Climber climber = begin_climb(
      target, *kernel, /*rungs=*/1, metric, /*warms_up=*/true,
      [&](Rng& r) { return exact_draw(target, 1, r); }, rng);
  ChainState state = exact_draw(target, 1, same);
  const double step_size = initial_step_size(target, {0.5, metric}, state, same);
  EXPECT_EQ(climber.target_settings().step_size, step_size);
  for (int t = 0; t < 50; ++t) {
    const TransitionInfo info = kernel->step(target, {step_size, metric}, state, same);
    const ClimberStep step = next_step(target, *kernel, climber, rng);
    EXPECT_EQ(step.on_target.energy, info.energy);
    EXPECT_EQ(step.on_target.evaluations, info.evaluations);
    take_step(step, /*warmup=*/false, climber);
    ASSERT_EQ(climber.on_target().position.continuous, state.position.continuous);
  }
  EXPECT_EQ(rng.position(), same.position());
}

TEST(Climber, goes_on_with_ladder_and_metrics_after_a_window_that_adapts_them_else_with_steps) {
  const FunctionDensity target = seen_with_an_error();
  Rng rng(207);
  Climber climber = exact_climber(target, {0, 0.3, 1}, 0.7, rng);
  const LadderSettings agreed{{0, 0.1, 1},
                              {settings_with(0.2, 2 * Eigen::Matrix2d::Identity()),
                               settings_with(0.3, 3 * Eigen::Matrix2d::Identity())}};
  go_on_with(agreed, /*adapts_metric=*/false, climber);
  EXPECT_EQ(climber.betas[1], 0.3);
  EXPECT_EQ(climber.target_settings().step_size, 0.3);
  EXPECT_NE(climber.target_settings().metric, agreed.rungs[1].metric);
  go_on_with(agreed, /*adapts_metric=*/true, climber);
  EXPECT_EQ(climber.betas, agreed.betas);
  EXPECT_EQ(climber.target_settings().metric, agreed.rungs[1].metric);
  EXPECT_EQ(climber.warmups[0].settings().metric, agreed.rungs[0].metric);
}

}  // namespace
}  // namespace patina
