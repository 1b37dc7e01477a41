#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// N(0, 1) on one half line; on the other an evaluation that a kernel must never accept.
FunctionTarget half_broken(double log_density, double gradient) {
  return {1, [=](const Position& position) {
            const Eigen::VectorXd& x = position.continuous;
            if (x[0] > 0) return Evaluation{log_density, Eigen::VectorXd::Constant(1, gradient)};
            return Evaluation{-0.5 * x.squaredNorm(), -x};
          }};
}

TEST(Kernel, never_accepts_what_is_not_finite_and_says_so) {
  for (const auto& [value, gradient] :
       {std::pair{kNaN, 0.0}, {kInfinity, 0.0}, {-kInfinity, 0.0}, {0.0, kNaN}, {0.0, kInfinity}}) {
    const FunctionTarget target = half_broken(value, gradient);
    const KernelSettings settings = settings_with(1.5, Eigen::MatrixXd::Identity(1, 1));
    Rng rng(51);
    ChainState state = state_at(target, {Eigen::VectorXd::Constant(1, -0.5), {}});
    int divergent = 0;
    for (int t = 0; t < 500; ++t) {
      const TransitionInfo info = make_mala()->step(target, settings, state, rng);
      ASSERT_LE(state.position.continuous[0], 0);
      if (!info.divergent) continue;
      ++divergent;
      EXPECT_EQ(info.accept_probability, 0);
      EXPECT_FALSE(info.accepted);
    }
    EXPECT_GT(divergent, 20) << "value " << value << ", gradient " << gradient;
  }
}

TEST(MetropolisStep, never_accepts_a_ratio_that_is_not_a_number_nor_one_place_without_density_for_another) {
  const ChainState somewhere{{Eigen::VectorXd::Zero(1), {}}, {-1, Eigen::VectorXd::Zero(1)}};
  const ChainState nowhere{{Eigen::VectorXd::Ones(1), {}}, {-kInfinity, Eigen::VectorXd::Zero(1)}};
  Rng rng(60);
  ChainState state = somewhere;
  EXPECT_EQ(metropolis_step(MoveKind::continuous, kNaN, 1000, somewhere, state, rng).accept_probability, 0);
  state = nowhere;
  EXPECT_FALSE(metropolis_step(MoveKind::continuous, kInfinity, 1000, nowhere, state, rng).accepted);
  EXPECT_TRUE(metropolis_step(MoveKind::continuous, kInfinity, 1000, somewhere, state, rng).accepted);
}

TEST(Kernel, never_accepts_a_level_without_density) {
  const FunctionTarget target(
      1,
      [](const Position& p) {
        return Evaluation{p.discrete[0] == 0 ? -0.5 * p.continuous.squaredNorm() : kNaN, -p.continuous};
      },
      {3});
  Rng rng(52);
  ChainState state = state_at(target, {Eigen::VectorXd::Zero(1), Eigen::VectorXi::Zero(1)});
  for (int t = 0; t < 100; ++t) {
    make_discrete_move()->step(target, {}, state, rng);
    ASSERT_EQ(state.position.discrete[0], 0);
  }
}

TEST(Kernel, repeats_the_state_bit_for_bit_when_it_rejects) {
  const GaussianTarget target(Eigen::VectorXd::Zero(3), some_covariance(3));
  const KernelSettings settings = settings_with(2.5, some_covariance(3));
  Rng rng(53);
  ChainState state = state_at(target, {Eigen::VectorXd::Constant(3, 0.1), {}});
  int rejected = 0;
  for (int t = 0; t < 300; ++t) {
    const ChainState before = state;
    const TransitionInfo info = make_mala()->step(target, settings, state, rng);
    EXPECT_EQ(info.energy, -state.evaluation.log_density);
    EXPECT_EQ(info.evaluations, 1);
    if (info.accepted) continue;
    ++rejected;
    EXPECT_EQ(state.position.continuous, before.position.continuous);
    EXPECT_EQ(state.evaluation.gradient, before.evaluation.gradient);
    EXPECT_EQ(state.evaluation.log_density, before.evaluation.log_density);
  }
  EXPECT_GT(rejected, 20);
  EXPECT_LT(rejected, 300);
}

TEST(Kernel, keeps_the_evaluation_of_where_it_is) {
  const GaussianTarget target(Eigen::VectorXd::Zero(3), some_covariance(3));
  Rng rng(54);
  ChainState state = state_at(target, {Eigen::VectorXd::Ones(3), {}});
  for (int t = 0; t < 50; ++t) make_mala()->step(target, settings_with(1, some_covariance(3)), state, rng);
  const Evaluation fresh = target.evaluate(state.position);
  EXPECT_EQ(fresh.log_density, state.evaluation.log_density);
  EXPECT_EQ(fresh.gradient, state.evaluation.gradient);
}

TEST(Kernel, leaves_a_start_without_density_as_soon_as_it_finds_some) {
  const FunctionTarget target = half_broken(-kInfinity, 0);
  Rng rng(55);
  ChainState state = state_at(target, {Eigen::VectorXd::Constant(1, 0.1), {}});
  for (int t = 0; t < 50; ++t)
    make_mala()->step(target, settings_with(1, Eigen::MatrixXd::Identity(1, 1)), state, rng);
  EXPECT_TRUE(std::isfinite(state.evaluation.log_density));
}

TEST(Kernel, flags_a_fall_by_more_than_a_thousand) {
  const GaussianTarget stiff(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 1e-8));
  Rng rng(56);
  ChainState state = state_at(stiff, {Eigen::VectorXd::Zero(1), {}});
  const TransitionInfo info =
      make_mala()->step(stiff, settings_with(1, Eigen::MatrixXd::Identity(1, 1)), state, rng);
  EXPECT_TRUE(info.divergent);
  EXPECT_FALSE(info.accepted);
}

TEST(Kernel, lets_what_a_target_throws_pass) {
  const FunctionTarget target(1,
                              [](const Position&) -> Evaluation { throw std::runtime_error("no device"); });
  Rng rng(57);
  ChainState state{{Eigen::VectorXd::Zero(1), {}}, {0, Eigen::VectorXd::Zero(1)}};
  EXPECT_THROW(make_mala()->step(target, settings_with(1, Eigen::MatrixXd::Identity(1, 1)), state, rng),
               std::runtime_error);
}

TEST(Kernel, draws_the_same_chain_from_the_same_seed) {
  const GaussianTarget target(Eigen::VectorXd::Zero(3), some_covariance(3));
  const auto chain = [&] {
    Rng rng(58, 2);
    ChainState state = state_at(target, {Eigen::VectorXd::Ones(3), {}});
    for (int t = 0; t < 50; ++t) make_mala()->step(target, settings_with(1, some_covariance(3)), state, rng);
    return state.position.continuous;
  };
  EXPECT_EQ(chain(), chain());
}

TEST(MakeKernel, knows_its_names_and_refuses_others) {
  const GaussianTarget target(Eigen::VectorXd::Zero(2), some_covariance(2));
  for (const std::string& name : kernel_names()) EXPECT_TRUE(make_kernel(name, target, 0.8));
  EXPECT_THROW(make_kernel("gibbs", target, 0.8), std::invalid_argument);
  for (const double alpha : {0.0, -0.1, 1.1, kNaN})
    EXPECT_THROW(make_kernel("mala", target, alpha), std::invalid_argument) << alpha;
}

TEST(MakeKernel, mixes_in_discrete_moves_only_where_there_are_levels) {
  const FunctionTarget levels_only(0, [](const Position&) { return Evaluation{0, Eigen::VectorXd(0)}; }, {4});
  Rng rng(59);
  ChainState state = state_at(levels_only, {Eigen::VectorXd(0), Eigen::VectorXi::Zero(1)});
  const auto kernel = make_kernel("mala", levels_only, 0.9);
  for (int t = 0; t < 20; ++t) EXPECT_EQ(kernel->step(levels_only, {}, state, rng).move, MoveKind::discrete);
}

}  // namespace
}  // namespace patina
