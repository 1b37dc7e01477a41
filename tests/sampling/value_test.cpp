// Moves that need no gradient ask for the value alone; whoever needs one later asks for it then.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "engine/sampling/kernels.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

/// A correlated normal law with three levels, which knows how to leave its gradient out and counts.
class Counted final : public LogDensity {
 public:
  explicit Counted(bool leaves_gradient_out, double broken_above = std::numeric_limits<double>::infinity())
      : leaves_gradient_out_(leaves_gradient_out), broken_above_(broken_above) {}

  Eigen::Index dimension() const override { return 2; }
  std::vector<int> discrete_levels() const override { return {3}; }
  Evaluation evaluate(const Position& p) const override {
    ++evaluations;
    const double x = p.continuous[0], y = p.continuous[1] - 0.5 * p.discrete[0];
    Eigen::VectorXd gradient = Eigen::Vector2d(-1.5 * x + 0.5 * y, -y + 0.5 * x);
    if (x > broken_above_) gradient.setConstant(std::numeric_limits<double>::quiet_NaN());
    return {-0.75 * x * x - 0.5 * y * y + 0.5 * x * y, gradient};
  }
  Evaluation value(const Position& p) const override {
    Evaluation evaluation = evaluate(p);
    if (!leaves_gradient_out_) return evaluation;
    --evaluations;
    ++values;
    return {evaluation.log_density, {}};
  }

  mutable int evaluations = 0, values = 0;  ///< with gradient, without

 private:
  bool leaves_gradient_out_;
  double broken_above_;
};

struct Walk {
  Eigen::MatrixXd places;  ///< [transitions, 2]
  int evaluations = 0, values = 0, told = 0;
};

Walk walk(const Counted& target, const Kernel& kernel) {
  constexpr int kTransitions = 2000;
  const KernelSettings settings = settings_with(0.5, Eigen::Matrix2d::Identity());
  Walk walk{Eigen::MatrixXd(kTransitions, 2)};
  ChainState state = state_at(target, {Eigen::Vector2d(-0.2, 0.1), Eigen::VectorXi::Zero(1)});
  target.evaluations = target.values = 0;
  Rng rng(8);
  for (int t = 0; t < kTransitions; ++t) {
    walk.told += kernel.step(target, settings, state, rng).evaluations;
    walk.places.row(t) = state.position.continuous.transpose();
  }
  walk.evaluations = target.evaluations;
  walk.values = target.values;
  return walk;
}

TEST(Value, moves_without_gradient_make_the_same_draws_from_values_alone) {
  const auto refresh = make_refresh_move(), levels = make_single_discrete_move(), random = make_random_walk(),
             scales = make_walk_of_all_scales();
  for (const Kernel* kernel : {refresh.get(), levels.get(), random.get(), scales.get()}) {
    const Walk lazy = walk(Counted(true), *kernel), eager = walk(Counted(false), *kernel);
    EXPECT_EQ(lazy.places, eager.places);
    EXPECT_EQ(lazy.evaluations, 0);
    EXPECT_EQ(lazy.values, 2000);
    EXPECT_EQ(lazy.told, 2000) << "values count as evaluations";
    EXPECT_EQ(eager.told, eager.evaluations);
  }
}

TEST(Value, gradient_kernels_make_up_for_a_gradient_that_was_left_out_once_and_draw_the_same) {
  for (const char* name : {"mala", "hmc", "nuts"}) {
    const Counted left_out(true), always(false);
    const auto kernel = make_kernel(name, left_out, /*alpha=*/0.8, /*refresh=*/0.5);
    const Walk lazy = walk(left_out, *kernel), eager = walk(always, *kernel);
    EXPECT_EQ(lazy.places, eager.places) << name;
    EXPECT_LT(lazy.evaluations, eager.evaluations) << name;
    EXPECT_EQ(lazy.told, lazy.evaluations + lazy.values) << name;
  }
}

TEST(Value, gradient_kernels_hold_a_state_whose_gradient_is_not_finite_as_they_never_lead_to_one) {
  const Counted target(true, /*broken_above=*/0.3);
  const KernelSettings settings = settings_with(0.5, Eigen::Matrix2d::Identity());
  for (const char* name : {"mala", "hmc", "nuts"}) {
    const auto kernel = make_kernel(name, target, 1);
    Rng rng(3);
    const Position there{Eigen::Vector2d(0.5, 0.1), Eigen::VectorXi::Zero(1)};
    ChainState state{there, target.value(there)};
    const TransitionInfo info = kernel->step(target, settings, state, rng);
    EXPECT_FALSE(info.accepted);
    EXPECT_TRUE(info.divergent);
    EXPECT_EQ(state.position.continuous, there.continuous);
    EXPECT_EQ(state.evaluation.log_density, target.value(there).log_density) << "its value stands";
    state = state_at(target, {Eigen::Vector2d(0.2, 0.1), Eigen::VectorXi::Zero(1)});
    for (int t = 0; t < 200; ++t) {
      kernel->step(target, settings, state, rng);
      ASSERT_LE(state.position.continuous[0], 0.3) << name;
    }
  }
}

}  // namespace
}  // namespace patina
