#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/sampling/kernels.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

/// Correlation of the first coordinate with itself one transition earlier.
double lag_one(const Kernel& kernel, const LogDensity& target, const KernelSettings& settings, int draws) {
  Rng rng(71);
  ChainState state = state_at(target, {Eigen::VectorXd::Zero(target.dimension()), {}});
  double sum = 0, squares = 0, products = 0, before = 0;
  for (int i = 0; i < draws; ++i) {
    kernel.step(target, settings, state, rng);
    const double x = state.position.continuous[0];
    sum += x, squares += x * x, products += x * before, before = x;
  }
  const double mean = sum / draws;
  return (products / draws - mean * mean) / (squares / draws - mean * mean);
}

TEST(Hmc, forgets_where_it_was_faster_than_mala_at_the_same_step) {
  const GaussianTarget target(Eigen::VectorXd::Zero(10), some_covariance(10));
  const KernelSettings settings = settings_with(0.25, some_covariance(10));
  EXPECT_LT(lag_one(*make_hmc(), target, settings, 4000), 0.3);
  EXPECT_GT(lag_one(*make_mala(), target, settings, 4000), 0.9);
}

TEST(Hmc, of_a_path_of_a_whole_period_still_mixes) {
  // On N(0, I) a path of 2 pi without jitter ends where it began.
  const GaussianTarget target(Eigen::VectorXd::Zero(2), Eigen::MatrixXd::Identity(2, 2));
  const KernelSettings settings = settings_with(0.2, Eigen::MatrixXd::Identity(2, 2));
  EXPECT_LT(std::abs(lag_one(*make_hmc(2 * std::numbers::pi), target, settings, 4000)), 0.6);
}

TEST(Hmc, leaves_a_place_too_narrow_for_its_step_when_some_trajectories_are_careful) {
  const GaussianTarget narrow(Eigen::VectorXd::Zero(2), 0.01 * 0.01 * Eigen::MatrixXd::Identity(2, 2));
  const KernelSettings settings = settings_with(0.08, Eigen::MatrixXd::Identity(2, 2));
  const auto accepted = [&](double careful) {
    Rng rng(77);
    ChainState state = state_at(narrow, {0.01 * rng.normals(2), {}});
    int count = 0;
    for (int i = 0; i < 500; ++i)
      count += make_hmc(1.5, 24, careful)->step(narrow, settings, state, rng).accepted;
    return count;
  };
  EXPECT_EQ(accepted(0), 0);
  EXPECT_GT(accepted(0.3), 30);
}

TEST(Hmc, counts_its_evaluations) {
  int evaluations = 0;
  const FunctionDensity target(1, [&](const Position& position) {
    ++evaluations;
    return Evaluation{-0.5 * position.continuous.squaredNorm(), -position.continuous};
  });
  Rng rng(72);
  ChainState state = state_at(target, {Eigen::VectorXd::Zero(1), {}});
  evaluations = 0;
  int counted = 0;
  for (int i = 0; i < 200; ++i)
    counted += make_hmc(1.5, 24, 0)
                   ->step(target, settings_with(0.3, Eigen::MatrixXd::Identity(1, 1)), state, rng)
                   .evaluations;
  EXPECT_EQ(counted, evaluations);
  EXPECT_NEAR(counted / 200.0, 1.5 / 0.3, 0.5);
}

TEST(Hmc, breaks_off_where_the_energy_has_risen_beyond_any_acceptance) {
  int evaluations = 0;
  const FunctionDensity cliff(1, [&](const Position& position) {
    ++evaluations;
    const double x = position.continuous[0];
    return Evaluation{std::abs(x) < 1 ? 0 : -1e6, Eigen::VectorXd::Zero(1)};
  });
  Rng rng(73);
  ChainState state = state_at(cliff, {Eigen::VectorXd::Zero(1), {}});
  int divergent = 0;
  for (int i = 0; i < 200; ++i) {
    const TransitionInfo info =
        make_hmc(9)->step(cliff, settings_with(0.5, Eigen::MatrixXd::Identity(1, 1)), state, rng);
    divergent += info.divergent;
    EXPECT_EQ(info.divergent && info.accepted, false);
    ASSERT_LT(std::abs(state.position.continuous[0]), 1);
  }
  EXPECT_GT(divergent, 100);
  EXPECT_LT(evaluations, 200 * 9);  // of some 18 a path
}

}  // namespace
}  // namespace patina
