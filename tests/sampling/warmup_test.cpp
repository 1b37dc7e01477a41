#include "engine/sampling/warmup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/sample.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

TEST(WarmupSchedule, covers_every_iteration_once_and_in_order) {
  for (int n : {0, 1, 5, 19, 20, 21, 100, 149, 150, 151, 500, 1000, 10000}) {
    int next = 0;
    for (const WarmupWindow& window : warmup_schedule(n)) {
      EXPECT_EQ(window.begin, next) << "of " << n;
      EXPECT_GT(window.end, window.begin) << "of " << n;
      next = window.end;
    }
    EXPECT_EQ(next, n);
  }
}

TEST(WarmupSchedule, is_stans_but_that_a_last_window_with_room_for_two_is_two) {
  using Ends = std::vector<std::pair<int, bool>>;
  const auto ends = [](int iterations) {
    Ends ends;
    for (const WarmupWindow& window : warmup_schedule(iterations))
      ends.emplace_back(window.end, window.adapts_metric);
    return ends;
  };
  EXPECT_EQ(
      ends(1000),
      (Ends{{75, false}, {100, true}, {150, true}, {250, true}, {450, true}, {950, true}, {1000, false}}));
  EXPECT_EQ(ends(600), (Ends{{75, false}, {100, true}, {150, true}, {250, true}, {550, true}, {600, false}}))
      << "a window of 200 would leave too little for one of 400";
  EXPECT_EQ(ends(1500), (Ends{{75, false},
                              {100, true},
                              {150, true},
                              {250, true},
                              {450, true},
                              {950, true},
                              {1450, true},
                              {1500, false}}))
      << "where Stan has one of 1000";
  EXPECT_EQ(ends(100), (Ends{{15, false}, {90, true}, {100, false}}));
}

TEST(WarmupSchedule, ends_with_the_step_size_alone) {
  for (int n : {1, 20, 100, 500}) EXPECT_FALSE(warmup_schedule(n).back().adapts_metric) << n;
}

/// Dual averaging against a made-up kernel whose acceptance falls with the step: a(step) = exp(-step /
/// scale).
TEST(StepSizeAdaptation, solves_acceptance_equal_to_target_on_a_known_curve) {
  for (const double scale : {1e-3, 1.0, 50.0}) {
    StepSizeAdaptation adaptation(1, 0.574);
    for (int t = 0; t < 5000; ++t) adaptation.observe(std::exp(-adaptation.step_size() / scale));
    EXPECT_NEAR(adaptation.averaged_step_size() / (-scale * std::log(0.574)), 1, 0.02);
  }
}

/// Hoffman & Gelman 2014, equation 6, after an acceptance of 0.9, then one of 0.2.
void expect_published_steps(StepSizeAdaptation adaptation, double gamma, double mu) {
  adaptation.observe(0.9);
  const double first = mu - 1 / gamma * (0.574 - 0.9) / 11;
  EXPECT_NEAR(std::log(adaptation.step_size()), first, 1e-12);
  EXPECT_NEAR(std::log(adaptation.averaged_step_size()), first, 1e-12);
  adaptation.observe(0.2);
  const double second = mu - std::sqrt(2) / gamma * (2 * 0.574 - 0.9 - 0.2) / 12;
  EXPECT_NEAR(std::log(adaptation.step_size()), second, 1e-12);
  const double weight = std::pow(2, -0.75);
  EXPECT_NEAR(std::log(adaptation.averaged_step_size()), weight * second + (1 - weight) * first, 1e-12);
}

TEST(StepSizeAdaptation, takes_the_published_steps_at_first_and_gentler_ones_after_a_restart) {
  StepSizeAdaptation adaptation(0.5, 0.574);
  expect_published_steps(adaptation, 0.05, std::log(5.0));
  adaptation.observe(0.3);
  adaptation.restart(0.2);
  expect_published_steps(adaptation, 0.4, std::log(0.2));
}

TEST(StepSizeAdaptation, takes_not_a_number_for_a_rejection) {
  StepSizeAdaptation with_nan(0.5, 0.574), with_zero(0.5, 0.574);
  with_nan.observe(std::numeric_limits<double>::quiet_NaN());
  with_zero.observe(0);
  EXPECT_EQ(with_nan.step_size(), with_zero.step_size());
  with_nan.restart(0.5);
  EXPECT_DOUBLE_EQ(with_nan.step_size(), 0.5);
  EXPECT_DOUBLE_EQ(with_nan.averaged_step_size(), 0.5);
}

TEST(ChainWarmup, reaches_the_target_acceptance_of_mala_on_a_gaussian) {
  const GaussianTarget target(Eigen::VectorXd::Zero(8), some_covariance(8));
  const auto kernel = make_mala();
  ChainWarmup warmup(settings_with(0.01, some_covariance(8)), kernel->target_acceptance());
  Rng rng(61);
  ChainState state = state_at(target, {Eigen::VectorXd::Zero(8), {}});
  for (int t = 0; t < 1500; ++t) warmup.observe(state, kernel->step(target, warmup.settings(), state, rng));
  const KernelSettings frozen{warmup.take_window().step_size, warmup.settings().metric};
  double acceptance = 0;
  constexpr int draws = 4000;
  for (int t = 0; t < draws; ++t)
    acceptance += kernel->step(target, frozen, state, rng).accept_probability / draws;
  EXPECT_NEAR(acceptance, 0.574, 0.04);
}

/// N(0, C) in 13 dimensions, as many as the leather has, with a table of levels that all weigh the same.
FunctionDensity gaussian_with_levels() {
  const Eigen::MatrixXd precision = some_covariance(13).inverse();
  return {13,
          [precision](const Position& p) {
            const Eigen::VectorXd gradient = -precision * p.continuous;
            return Evaluation{0.5 * p.continuous.dot(gradient), gradient};
          },
          {3, 4}};
}

TEST(Warmup, leaves_every_chain_near_the_acceptance_that_its_kernel_asks_for) {
  // With the default mixture a bit more than half of the transitions teach the step size anything.
  const FunctionDensity target = gaussian_with_levels();
  const Metric truth(some_covariance(13));
  const auto start = [&](Rng& rng) {
    return Position{1.4 * truth.colour(rng.normals(13)), Eigen::VectorXi::Zero(2)};
  };
  for (const std::string& name : kernel_names())
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      const auto kernel = make_kernel(name, target, 0.8, 0.3);
      const Sample drawn = sample(target, *kernel, {.seed = seed}, start, Metric::identity(13));
      const double wanted = kernel->target_acceptance();
      for (const double acceptance : drawn.acceptance)
        EXPECT_NEAR(acceptance, wanted, name == "nuts" || name == "hmc" ? 0.08 : 0.13) << name;
    }
}

TEST(InitialStepSize, brackets_an_acceptance_of_eighty_per_cent) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const GaussianTarget target(Eigen::VectorXd::Zero(8), scale * scale * Eigen::MatrixXd::Identity(8, 8));
    const KernelSettings settings = settings_with(0.5, Eigen::MatrixXd::Identity(8, 8));
    Rng rng(66);
    const ChainState state = state_at(target, {scale * rng.normals(8), {}});
    const double step = initial_step_size(target, settings, state, rng);
    EXPECT_GT(step, 0.1 * scale);
    EXPECT_LT(step, 8 * scale);
  }
}

TEST(ChainWarmup, learns_nothing_about_the_step_from_discrete_moves) {
  ChainWarmup warmup(settings_with(0.3, Eigen::MatrixXd::Identity(1, 1)), 0.574);
  const ChainState state{{Eigen::VectorXd::Zero(1), {}}, {0, Eigen::VectorXd::Zero(1)}};
  TransitionInfo info;
  info.move = MoveKind::discrete;
  for (int t = 0; t < 10; ++t) warmup.observe(state, info);
  EXPECT_DOUBLE_EQ(warmup.settings().step_size, 0.3);
  const WindowResult window = warmup.take_window();
  EXPECT_DOUBLE_EQ(window.step_size, 0.3);
  EXPECT_EQ(window.positions.cols(), 10);
  EXPECT_EQ(warmup.take_window().positions.cols(), 0) << "taken twice";
}

TEST(ChainWarmup, goes_on_from_what_was_pooled) {
  ChainWarmup warmup(settings_with(0.3, Eigen::MatrixXd::Identity(1, 1)), 0.574);
  const ChainState state{{Eigen::VectorXd::Zero(1), {}}, {0, Eigen::VectorXd::Zero(1)}};
  TransitionInfo info;
  info.accept_probability = 0.9;
  for (int t = 0; t < 10; ++t) warmup.observe(state, info);
  EXPECT_NE(warmup.settings().step_size, 0.3);
  const KernelSettings pooled = settings_with(0.7, Eigen::MatrixXd::Constant(1, 1, 4));
  warmup.restart(pooled);
  EXPECT_EQ(warmup.settings().metric, pooled.metric);
  EXPECT_DOUBLE_EQ(warmup.settings().step_size, 0.7);
  EXPECT_DOUBLE_EQ(warmup.take_window().step_size, 0.7);
}

TEST(Pool, takes_the_median_step_in_logs_and_the_kind_of_metric_that_was_asked_for) {
  Rng rng(65);
  std::vector<WindowResult> chains;
  for (const double step : {0.9, 1e-6, 0.4, 0.1}) chains.push_back({Eigen::MatrixXd(2, 50), step, nullptr});
  for (WindowResult& chain : chains)
    for (auto column : chain.positions.colwise()) column = Metric(some_covariance(2)).colour(rng.normals(2));
  EXPECT_DOUBLE_EQ(pool(chains, MetricKind::dense).step_size, std::sqrt(0.1 * 0.4));
  const Eigen::Matrix2d dense = pool(chains, MetricKind::dense).metric->covariance();
  const Eigen::Matrix2d diagonal = pool(chains, MetricKind::diagonal).metric->covariance();
  EXPECT_NE(dense(0, 1), 0);
  EXPECT_EQ(diagonal(0, 1), 0);
  EXPECT_EQ(diagonal.diagonal(), dense.diagonal());
  EXPECT_EQ(pool(chains, MetricKind::identity).metric->covariance(), Eigen::Matrix2d::Identity());
  chains.pop_back();
  EXPECT_DOUBLE_EQ(pool(chains, MetricKind::dense).step_size, 0.4);
}

TEST(Pool, keeps_the_windows_metric_in_proportion_to_its_worth) {
  Rng rng(67);
  const auto metric = std::make_shared<const Metric>(some_covariance(3));
  std::vector<WindowResult> chains(3, {Eigen::MatrixXd(3, 20), 0.5, metric});
  for (WindowResult& chain : chains)
    for (auto column : chain.positions.colwise()) column = rng.normals(3);
  const Eigen::Matrix3d seen = pool(chains, MetricKind::dense).metric->covariance();
  const Eigen::Matrix3d kept = pool(chains, MetricKind::dense, 180).metric->covariance();
  EXPECT_TRUE(kept.isApprox(0.25 * seen + 0.75 * some_covariance(3), 1e-12));
}

TEST(Warmup, that_is_short_gains_from_a_metric_that_is_about_right) {
  const Metric truth(some_covariance(23));
  const GaussianTarget target(Eigen::VectorXd::Zero(23), truth.covariance());
  const Metric about_right(1.3 * truth.covariance() + 0.02 * Eigen::MatrixXd::Identity(23, 23));
  const auto start = [&](Rng& rng) { return Position{1.4 * truth.colour(rng.normals(23)), {}}; };
  const auto least_ess = [&](double worth) {
    const SampleSettings settings{.warmup = 200, .draws = 3000, .metric_worth = worth};
    double least = 1e300;
    for (const auto& x : sample(target, *make_mala(), settings, start, about_right).coordinates)
      least = std::min(least, mean_ess(x));
    return least;
  };
  EXPECT_GT(least_ess(230), 2 * least_ess(0));
}

TEST(PooledCovariance, is_the_shrunk_within_chain_covariance) {
  // Two chains about far-apart means, each with covariance diag(2, 0) by hand: (+-1 about the mean, ddof 1).
  Eigen::MatrixXd first(2, 2), second(2, 2);
  first << 9, 11, 1, 1;
  second << -1, 1, 5, 5;
  Eigen::Matrix2d expected = Eigen::Vector2d(4.0 / 9 * 2, 0).asDiagonal();
  expected += 1e-3 * 5 / 9 * Eigen::Matrix2d::Identity();
  EXPECT_TRUE(pooled_covariance({first, second}).isApprox(expected, 1e-14));
}

TEST(PooledCovariance, estimates_the_covariance_of_many_draws) {
  const Metric truth(some_covariance(4));
  Rng rng(62);
  std::vector<Eigen::MatrixXd> chains(4, Eigen::MatrixXd(4, 5000));
  for (Eigen::MatrixXd& chain : chains)
    for (auto column : chain.colwise()) column = truth.colour(rng.normals(4));
  EXPECT_LT((pooled_covariance(chains) - truth.covariance()).norm() / truth.covariance().norm(), 0.05);
}

TEST(PooledCovariance, makes_a_metric_however_little_was_seen) {
  const Eigen::MatrixXd one_draw = Eigen::MatrixXd::Ones(3, 1);
  EXPECT_NO_THROW(Metric{pooled_covariance({one_draw})});
  EXPECT_NO_THROW(Metric{pooled_covariance({one_draw, Eigen::MatrixXd()})});
}

}  // namespace
}  // namespace patina
