#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// N(0, 1) on one half line; on the other an evaluation that a kernel must never accept.
FunctionDensity half_broken(double log_density, double gradient) {
  return {1, [=](const Position& position) {
            const Eigen::VectorXd& x = position.continuous;
            if (x[0] > 0) return Evaluation{log_density, Eigen::VectorXd::Constant(1, gradient)};
            return Evaluation{-0.5 * x.squaredNorm(), -x};
          }};
}

TEST(Kernel, never_accepts_what_is_not_finite_and_says_so) {
  for (const std::string& name : kernel_names())
    for (const auto& [value, gradient] :
         {std::pair{kNaN, 0.0}, {kInfinity, 0.0}, {-kInfinity, 0.0}, {0.0, kNaN}, {0.0, kInfinity}}) {
      const FunctionDensity target = half_broken(value, gradient);
      const auto kernel = make_kernel(name, target, 1);
      const KernelSettings settings = settings_with(1.5, Eigen::MatrixXd::Identity(1, 1));
      Rng rng(51);
      ChainState state = state_at(target, {Eigen::VectorXd::Constant(1, -0.5), {}});
      int divergent = 0;
      for (int t = 0; t < 500; ++t) {
        const TransitionInfo info = kernel->step(target, settings, state, rng);
        ASSERT_LE(state.position.continuous[0], 0) << name;
        ASSERT_TRUE(info.accept_probability >= 0 && info.accept_probability <= 1) << name;
        divergent += info.divergent;
        if (!info.divergent || name == "nuts") continue;  // a tree holds more than the point it met last
        EXPECT_EQ(info.accept_probability, 0) << name;
        EXPECT_FALSE(info.accepted) << name;
      }
      EXPECT_GT(divergent, 20) << name << ", value " << value << ", gradient " << gradient;
    }
}

TEST(WalkOfAllScales, goes_on_where_a_walk_of_one_step_is_stuck_and_teaches_no_step_size) {
  const GaussianTarget narrow(Eigen::VectorXd::Zero(8), 0.04 * 0.04 * Eigen::MatrixXd::Identity(8, 8));
  const KernelSettings settings = settings_with(0.3, Eigen::MatrixXd::Identity(8, 8));
  const auto accepted = [&](const Kernel& kernel) {
    Rng rng(78);
    ChainState state = state_at(narrow, {0.04 * rng.normals(8), {}});
    int count = 0;
    for (int i = 0; i < 500; ++i) count += kernel.step(narrow, settings, state, rng).accepted;
    return count;
  };
  EXPECT_EQ(accepted(*make_random_walk()), 0);
  EXPECT_GT(accepted(*make_walk_of_all_scales()), 30);
  Rng rng(79);
  ChainState state = state_at(narrow, {Eigen::VectorXd::Zero(8), {}});
  EXPECT_NE(make_walk_of_all_scales()->step(narrow, settings, state, rng).move, MoveKind::continuous);
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
  const FunctionDensity target(
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

bool same(const ChainState& a, const ChainState& b) {
  return a.position.continuous == b.position.continuous && a.evaluation.gradient == b.evaluation.gradient &&
         a.evaluation.log_density == b.evaluation.log_density;
}

TEST(Kernel, repeats_the_state_bit_for_bit_when_it_rejects) {
  const GaussianTarget target(Eigen::VectorXd::Zero(3), some_covariance(3));
  for (const std::string& name : kernel_names()) {
    const KernelSettings settings = settings_with(name == "nuts" ? 1.7 : 1.9, some_covariance(3));
    const auto kernel = make_kernel(name, target, 1);
    Rng rng(53);
    ChainState state = state_at(target, {Eigen::VectorXd::Constant(3, 0.1), {}});
    int rejected = 0;
    for (int t = 0; t < 400; ++t) {
      const ChainState before = state;
      const bool accepted = kernel->step(target, settings, state, rng).accepted;
      EXPECT_NE(accepted, same(state, before)) << name;
      rejected += !accepted;
    }
    EXPECT_GT(rejected, 20) << name;
    EXPECT_LT(rejected, 400) << name;
  }
}

TEST(Kernel, has_the_energy_of_where_it_is_and_no_less) {
  const GaussianTarget target(Eigen::VectorXd::Zero(3), some_covariance(3));
  for (const std::string& name : kernel_names()) {
    const bool kinetic = name == "hmc" || name == "nuts";
    const auto kernel = make_kernel(name, target, 1);
    Rng rng(64);
    ChainState state = state_at(target, {Eigen::VectorXd::Constant(3, 0.1), {}});
    double mean_excess = 0;
    constexpr int transitions = 4000;
    for (int t = 0; t < transitions; ++t) {
      const TransitionInfo info = kernel->step(target, settings_with(0.9, some_covariance(3)), state, rng);
      const double excess = info.energy + state.evaluation.log_density;
      EXPECT_GE(excess, -1e-12) << name;
      mean_excess += excess / transitions;
    }
    // Half a unit for each of three momenta, chi-square with three degrees of freedom.
    EXPECT_NEAR(mean_excess, kinetic ? 1.5 : 0, kinetic ? 5 * std::sqrt(1.5 / transitions) * 2 : 1e-12)
        << name;
  }
}

TEST(Kernel, evaluates_no_point_twice_counts_all_and_keeps_the_one_of_where_it_is) {
  const GaussianTarget gaussian(Eigen::VectorXd::Zero(3), some_covariance(3));
  for (const std::string& name : kernel_names()) {
    std::set<std::vector<double>> seen;
    int evaluations = 0, counted = 0;
    const FunctionDensity target(3, [&](const Position& p) {
      ++evaluations;
      EXPECT_TRUE(seen.emplace(p.continuous.begin(), p.continuous.end()).second) << name;
      return gaussian.evaluate(p);
    });
    const auto kernel = make_kernel(name, target, 1);
    Rng rng(54);
    ChainState state = state_at(gaussian, {Eigen::VectorXd::Ones(3), {}});
    for (int t = 0; t < 100; ++t)
      counted += kernel->step(target, settings_with(0.6, some_covariance(3)), state, rng).evaluations;
    EXPECT_EQ(counted, evaluations) << name;
    EXPECT_TRUE(same(state, state_at(gaussian, state.position))) << name;
  }
}

TEST(Kernel, leaves_a_start_without_density_as_soon_as_it_finds_some) {
  const FunctionDensity target = half_broken(-kInfinity, 0);
  for (const std::string& name : kernel_names()) {
    const auto kernel = make_kernel(name, target, 1);
    Rng rng(55);
    ChainState state = state_at(target, {Eigen::VectorXd::Constant(1, 0.1), {}});
    for (int t = 0; t < 50; ++t)
      kernel->step(target, settings_with(1, Eigen::MatrixXd::Identity(1, 1)), state, rng);
    EXPECT_TRUE(std::isfinite(state.evaluation.log_density)) << name;
  }
}

TEST(Kernel, flags_a_fall_by_more_than_a_thousand) {
  const GaussianTarget stiff(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 1e-8));
  for (const char* name : {"mala", "hmc", "nuts"}) {
    Rng rng(56);
    ChainState state = state_at(stiff, {Eigen::VectorXd::Zero(1), {}});
    const TransitionInfo info =
        make_kernel(name, stiff, 1)
            ->step(stiff, settings_with(0.2, Eigen::MatrixXd::Identity(1, 1)), state, rng);
    EXPECT_TRUE(info.divergent) << name;
    EXPECT_FALSE(info.accepted) << name;
    EXPECT_EQ(info.evaluations, 1) << name << ": a path that is lost is not followed further";
  }
}

TEST(Kernel, lets_what_a_target_throws_pass_and_stays_where_it_was) {
  const GaussianTarget gaussian(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1));
  for (const std::string& name : kernel_names())
    for (const int last : {0, 1, 2}) {
      int evaluations = 0;
      const FunctionDensity target(1, [&](const Position& p) {
        if (evaluations++ == last) throw std::runtime_error("no device");
        return gaussian.evaluate(p);
      });
      const auto kernel = make_kernel(name, target, 1);
      Rng rng(57);
      ChainState state = state_at(gaussian, {Eigen::VectorXd::Constant(1, 0.3), {}});
      ChainState before = state;
      const auto go_on = [&] {
        for (int t = 0; t < 10; ++t) {
          before = state;
          kernel->step(target, settings_with(0.1, Eigen::MatrixXd::Identity(1, 1)), state, rng);
        }
      };
      EXPECT_THROW(go_on(), std::runtime_error) << name;
      EXPECT_TRUE(same(state, before)) << name;
    }
}

TEST(Kernel, draws_the_same_chain_from_the_same_seed) {
  const GaussianTarget target(Eigen::VectorXd::Zero(3), some_covariance(3));
  const auto chain = [&](const Kernel& kernel) {
    Rng rng(58, 2);
    ChainState state = state_at(target, {Eigen::VectorXd::Ones(3), {}});
    for (int t = 0; t < 50; ++t) kernel.step(target, settings_with(1, some_covariance(3)), state, rng);
    return state.position.continuous;
  };
  for (const std::string& name : kernel_names())
    EXPECT_EQ(chain(*make_kernel(name, target, 1)), chain(*make_kernel(name, target, 1))) << name;
}

TEST(MakeKernel, knows_its_names_and_refuses_others) {
  const GaussianTarget target(Eigen::VectorXd::Zero(2), some_covariance(2));
  for (const std::string& name : kernel_names()) EXPECT_TRUE(make_kernel(name, target, 0.8));
  EXPECT_THROW(make_kernel("gibbs", target, 0.8), std::invalid_argument);
  for (const double alpha : {0.0, -0.1, 1.1, kNaN})
    EXPECT_THROW(make_kernel("mala", target, alpha), std::invalid_argument) << alpha;
}

TEST(MakeKernel, mixes_in_discrete_moves_only_where_there_are_levels) {
  const FunctionDensity levels_only(0,
                                    [](const Position&) {
                                      return Evaluation{0, Eigen::VectorXd(0)};
                                    },
                                    {4});
  Rng rng(59);
  ChainState state = state_at(levels_only, {Eigen::VectorXd(0), Eigen::VectorXi::Zero(1)});
  const auto kernel = make_kernel("mala", levels_only, 0.9);
  for (int t = 0; t < 20; ++t) EXPECT_EQ(kernel->step(levels_only, {}, state, rng).move, MoveKind::discrete);
}

}  // namespace
}  // namespace patina
