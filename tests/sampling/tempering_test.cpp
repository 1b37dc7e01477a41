#include "engine/sampling/tempering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/sampling/kernels.h"
#include "engine/sampling/prior_draw.h"
#include "tests/sampling/seen_with_an_error.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

TEST(TemperedDensity, at_one_is_the_target_to_the_last_bit) {
  const FunctionDensity target = seen_with_an_error();
  const TemperedDensity same(target, 1);
  Rng rng(101);
  for (int i = 0; i < 20; ++i) {
    const ChainState state = prior_state(target, rng);
    EXPECT_EQ(same.evaluate(state.position).log_density, state.evaluation.log_density);
    EXPECT_EQ(same.evaluate(state.position).gradient, state.evaluation.gradient);
    EXPECT_EQ(same.untempered(same.tempered(state)).evaluation.gradient, state.evaluation.gradient);
  }
}

TEST(TemperedDensity, has_the_slope_of_its_value_and_the_moments_of_its_formula) {
  const FunctionDensity target = seen_with_an_error();
  Rng rng(102);
  for (const double beta : {0.01, 0.3, 0.8}) {
    const TemperedDensity tempered(target, beta);
    for (int repeat = 0; repeat < 10; ++repeat) {
      const ChainState state = prior_state(target, rng);
      const Evaluation here = tempered.evaluate(state.position);
      for (int i = 0; i < 2; ++i) {
        Position up = state.position, down = state.position;
        up.continuous[i] += 1e-5;
        down.continuous[i] -= 1e-5;
        const double slope = (tempered.evaluate(up).log_density - tempered.evaluate(down).log_density) / 2e-5;
        EXPECT_NEAR(slope, here.gradient[i], 1e-6 * (1 + std::abs(slope)));
        EXPECT_NEAR(here.gradient[i],
                    (mean_at(beta, i) - state.position.continuous[i]) / std::pow(sd_at(beta), 2),
                    1e-10 * (1 + std::abs(slope)));
      }
      const ChainState back = tempered.untempered(tempered.tempered(state));
      EXPECT_NEAR(back.evaluation.log_density, state.evaluation.log_density, 1e-10);
      EXPECT_TRUE(back.evaluation.gradient.isApprox(state.evaluation.gradient, 1e-10));
    }
  }
}

/// Knows how to leave its gradient out.
class Lazy final : public LogDensity {
 public:
  Eigen::Index dimension() const override { return 2; }
  Evaluation evaluate(const Position& p) const override { return target_.evaluate(p); }
  Evaluation value(const Position& p) const override { return {target_.evaluate(p).log_density, {}}; }

 private:
  FunctionDensity target_ = seen_with_an_error();
};

TEST(TemperedDensity, leaves_out_the_gradient_that_its_target_leaves_out) {
  const Lazy lazy;
  const FunctionDensity eager = seen_with_an_error();
  const TemperedDensity tempered(lazy, 0.3), of_eager(eager, 0.3);
  const Position position{Eigen::Vector2d(0.4, -1.2), {}};
  const Evaluation expected = tempered.evaluate(position);
  EXPECT_EQ(tempered.value(position).log_density, expected.log_density);
  EXPECT_EQ(tempered.value(position).gradient.size(), 0);
  EXPECT_EQ(of_eager.value(position).log_density, expected.log_density);
  EXPECT_EQ(of_eager.value(position).gradient, expected.gradient);
}

TEST(TemperedDensity, says_nothing_along_jagged_coordinates) {
  const JaggedTarget target(Eigen::VectorXd::Zero(3), some_covariance(3));
  const TemperedDensity tempered(target, 0.5);
  EXPECT_EQ(tempered.jagged(), target.jagged());
  EXPECT_EQ(tempered.evaluate({Eigen::VectorXd::Ones(3), {}}).gradient[0], 0);
}

/// worst_distance() after some rounds from exact draws.
double distance_after_rounds(const std::vector<double>& betas, const std::vector<double>& swapped_by) {
  constexpr int kRepeats = 20000;
  const FunctionDensity target = seen_with_an_error();
  const auto kernel = make_hmc();
  std::vector<std::vector<double>> ends(2 * betas.size());
  Rng rng(103);
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    std::vector<ChainState> rungs;
    for (const double beta : betas) rungs.push_back(exact_draw(target, beta, rng));
    TemperedState state = tempered_state(rungs);
    SwapRecord record(betas.size());
    for (int round = 0; round < 3; ++round) {
      state.rungs.front() = prior_state(target, rng);
      for (std::size_t i = 1; i < betas.size(); ++i) {
        const TemperedDensity density(target, betas[i]);
        ChainState tempered = density.tempered(state.rungs[i]);
        kernel->step(density, settings_with(0.7, std::pow(sd_at(betas[i]), 2) * Eigen::Matrix2d::Identity()),
                     tempered, rng);
        state.rungs[i] = density.untempered(tempered);
      }
      swap_rungs(swapped_by, state, record, rng);
    }
    for (std::size_t i = 0; i < ends.size(); ++i)
      ends[i].push_back(state.rungs[i / 2].position.continuous[static_cast<Eigen::Index>(i % 2)]);
  }
  return worst_distance(betas, ends);
}

TEST(Tempering, keeps_exact_draws_of_every_rung_exact) {
  const std::vector<double> betas{0, 0.05, 0.3, 1};
  EXPECT_LT(distance_after_rounds(betas, betas), 1);
}

TEST(Tempering, loses_them_when_swaps_are_decided_by_another_ladder) {
  EXPECT_GT(distance_after_rounds({0, 0.05, 0.3, 1}, {0, 0.03, 0.25, 1}), 1);
}

/// Rounds in which every rung forgets where it was: the travellers of theory.
SwapRecord rounds_of_exact_draws(const std::vector<double>& betas, int rounds, TemperedState& state,
                                 Rng& rng) {
  const FunctionDensity target = seen_with_an_error();
  SwapRecord record(betas.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < betas.size(); ++i) state.rungs[i] = exact_draw(target, betas[i], rng);
    swap_rungs(betas, state, record, rng);
  }
  return record;
}

TemperedState blank(std::size_t rungs) { return tempered_state(std::vector<ChainState>(rungs)); }

TEST(Tempering, makes_as_many_round_trips_as_theory_says) {
  for (const std::vector<double>& betas :
       {std::vector<double>{0, 1}, {0, 0.02, 0.1, 0.4, 1}, {0, 0.01, 0.03, 0.07, 0.15, 0.3, 0.6, 1}}) {
    constexpr int kRounds = 60000;
    TemperedState state = blank(betas.size());
    Rng rng(104);
    const SwapRecord record = rounds_of_exact_draws(betas, kRounds, state, rng);
    const double rate = static_cast<double>(state.round_trips) / kRounds;
    EXPECT_NEAR(rate / ideal_round_trip_rate(record.rejection()), 1, 0.05) << betas.size() << " rungs";
  }
}

TEST(Tempering, that_picked_even_or_odd_at_random_would_make_fewer_round_trips) {
  const std::vector<double> betas{0, 0.01, 0.03, 0.07, 0.15, 0.3, 0.6, 1};
  TemperedState state = blank(betas.size());
  Rng rng(105), coin(106);
  SwapRecord record(betas.size());
  constexpr int kRounds = 20000;
  for (int round = 0; round < kRounds; ++round) {
    state.rounds = coin.below(2);
    record.add(rounds_of_exact_draws(betas, 1, state, rng));
  }
  const double rate = static_cast<double>(state.round_trips) / kRounds;
  EXPECT_LT(rate, 0.7 * ideal_round_trip_rate(record.rejection()));
}

TEST(Tempering, tries_each_pair_every_other_round_and_never_accepts_a_place_without_density) {
  const std::vector<double> betas{0, 0.5, 1};
  const FunctionDensity target = seen_with_an_error();
  Rng rng(107);
  TemperedState state = blank(3);
  SwapRecord record(3);
  for (int round = 0; round < 100; ++round) {
    for (std::size_t i = 0; i < 3; ++i) state.rungs[i] = exact_draw(target, betas[i], rng);
    state.rungs[0].evaluation.log_density = -std::numeric_limits<double>::infinity();
    swap_rungs(betas, state, record, rng);
    ASSERT_TRUE(std::isfinite(state.rungs[1].evaluation.log_density));
  }
  EXPECT_EQ(record.rejection()[0], 1);
  EXPECT_LT(record.rejection()[1], 0.9);
}

TEST(TemperedMetric, is_the_covariance_of_a_normal_density_and_at_one_the_targets_own) {
  const auto metric = std::make_shared<const Metric>(some_covariance(3));
  EXPECT_EQ(tempered_metric(metric, 1), metric);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(3, 3);
  for (const double beta : {1e-6, 0.2, 0.9}) {
    const Eigen::MatrixXd precision = beta * metric->covariance().inverse() + (1 - beta) * identity;
    EXPECT_TRUE(tempered_metric(metric, beta)->covariance().isApprox(precision.inverse(), 1e-10));
  }
}

TEST(EqualisedLadder, stays_where_rejections_are_equal_and_moves_towards_where_they_are_many) {
  const std::vector<double> betas{0, 0.1, 0.4, 1};
  const std::vector<double> same = equalised_ladder(betas, {0.2, 0.2, 0.2});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(same[i], betas[i], 1e-12);
  const std::vector<double> moved = equalised_ladder(betas, {0.6, 0, 0});
  EXPECT_TRUE(std::ranges::is_sorted(moved));
  EXPECT_LT(moved[2], 0.1);
}

TEST(EqualisedLadder, of_repeated_rounds_rejects_equally_everywhere) {
  std::vector<double> betas = first_ladder(7);
  Rng rng(108);
  TemperedState state = blank(betas.size());
  const auto uneven = [&](int rounds) {
    const std::vector<double> rejection = rounds_of_exact_draws(betas, rounds, state, rng).rejection();
    const auto [least, most] = std::ranges::minmax(rejection);
    betas = equalised_ladder(betas, rejection);
    return most - least;
  };
  EXPECT_GT(uneven(5000), 0.1) << "the first ladder is no good, or this shows nothing";
  for (int i = 0; i < 4; ++i) uneven(5000);
  EXPECT_LT(uneven(20000), 0.03);
}

}  // namespace
}  // namespace patina
