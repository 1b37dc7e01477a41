#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/sampling/kernels.h"
#include "tests/sampling/plain_nuts.h"
#include "tests/sampling/skewed_target.h"

// What was made fast against what it was made from: chains that are equal to the last bit.

namespace patina {
namespace {

bool same(const ChainState& a, const ChainState& b) {
  return a.position.continuous == b.position.continuous && a.position.discrete == b.position.discrete &&
         a.evaluation.log_density == b.evaluation.log_density &&
         a.evaluation.gradient == b.evaluation.gradient;
}

/// Neal's funnel: its neck makes trajectories diverge.
FunctionDensity funnel() {
  return {5, [](const Position& p) {
            const Eigen::VectorXd& x = p.continuous;
            const double v = x[0], precision = std::exp(-v), rest = x.tail(4).squaredNorm();
            Evaluation result{-v * v / 18 - 2 * v - 0.5 * precision * rest, Eigen::VectorXd(5)};
            result.gradient << -v / 9 - 2 + 0.5 * precision * rest, -precision * x.tail(4);
            return result;
          }};
}

struct Walked {
  int transitions_that_moved = 0, deepest = 0, divergences = 0;
};

Walked walk_beside_the_plain_sampler(const LogDensity& target, Position start, double step_size) {
  constexpr int kDeepest = 7;
  const auto nuts = make_nuts(kDeepest);
  const KernelSettings settings = settings_with(step_size, some_covariance(target.dimension()));
  ChainState state = state_at(target, start), plain_state = state;
  Rng rng(91), plain_rng(91);
  Walked walked;
  for (int i = 0; i < 300; ++i) {
    const TransitionInfo info = nuts->step(target, settings, state, rng);
    plain::Nuts plain{target, settings, plain_rng};
    const int depth = plain.step(plain_state, kDeepest);
    EXPECT_TRUE(same(state, plain_state)) << "transition " << i;
    EXPECT_EQ(rng.position(), plain_rng.position());
    EXPECT_EQ(info.tree_depth, depth);
    EXPECT_EQ(info.evaluations, plain.leapfrogs);
    EXPECT_EQ(info.divergent, plain.divergent);
    if (testing::Test::HasFailure()) break;
    walked.transitions_that_moved += info.accepted;
    walked.deepest = std::max(walked.deepest, depth);
    walked.divergences += info.divergent;
  }
  return walked;
}

TEST(Nuts, equals_the_plain_recursion_to_the_last_bit) {
  const GaussianTarget gaussian(Eigen::VectorXd::Ones(23), some_covariance(23));
  const Walked wide = walk_beside_the_plain_sampler(gaussian, {Eigen::VectorXd::Zero(23), {}}, 0.4);
  EXPECT_GT(wide.transitions_that_moved, 200);
  EXPECT_GE(wide.deepest, 3);
  Rng rng(92);
  EXPECT_GE(walk_beside_the_plain_sampler(SkewedTarget(), SkewedTarget::exact_draw(rng), 0.05).deepest, 6);
  EXPECT_GT(walk_beside_the_plain_sampler(funnel(), {Eigen::VectorXd::Ones(5), {}}, 1.5).divergences, 3);
}

TEST(Leapfrog, equals_the_formula_to_the_last_bit) {
  const SkewedTarget target;
  const Metric metric(some_covariance(3));
  Rng rng(93);
  PhasePoint point{state_at(target, SkewedTarget::exact_draw(rng)), rng.normals(3)}, plain_point = point;
  for (int i = 0; i < 200; ++i) {
    const double step = i % 3 == 0 ? -0.1 : 0.13;
    leapfrog(target, metric, step, point);
    plain::leapfrog(target, metric, step, plain_point);
    ASSERT_TRUE(same(point.state, plain_point.state)) << i;
    ASSERT_EQ(point.momentum, plain_point.momentum) << i;
  }
}

/// A chain whose every transition sees a metric that was never asked anything before.
TEST(Metric, that_remembers_its_answers_makes_the_chain_of_one_that_does_not) {
  const JaggedTarget target(Eigen::VectorXd::Zero(6), some_covariance(6));
  const auto kernel = make_kernel("hmc", target, 1, 0.5);
  const KernelSettings remembering = settings_with(0.3, some_covariance(6));
  ChainState state = state_at(target, {Eigen::VectorXd::Zero(6), {}}), fresh_state = state;
  Rng rng(94), fresh_rng(94);
  int moved = 0;
  for (int i = 0; i < 300; ++i) {
    moved += kernel->step(target, remembering, state, rng).accepted;
    kernel->step(target, settings_with(0.3, some_covariance(6)), fresh_state, fresh_rng);
    ASSERT_TRUE(same(state, fresh_state)) << i;
  }
  EXPECT_GT(moved, 100);
}

TEST(Metric, remembers_the_block_that_it_was_asked_for_last) {
  const Metric metric(some_covariance(5));
  const auto expected = [](const std::vector<Eigen::Index>& block) {
    const Eigen::MatrixXd precision = some_covariance(5).inverse();
    return Eigen::MatrixXd(Eigen::MatrixXd(precision(block, block)).inverse());
  };
  for (const std::vector<Eigen::Index>& block :
       {std::vector<Eigen::Index>{0, 2}, {1, 2, 4}, {1, 2, 4}, {0, 2}})
    EXPECT_TRUE(metric.conditional(block)->covariance().isApprox(expected(block), 1e-10));
}

}  // namespace
}  // namespace patina
