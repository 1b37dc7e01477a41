// Moves that need no gradient ask for the value alone, and for the gradient where they end.
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
    return {evaluation.log_density, {}};
  }

  mutable int evaluations = 0;

 private:
  bool leaves_gradient_out_;
  double broken_above_;
};

struct Walk {
  Eigen::MatrixXd places;  ///< [transitions, 2]
  int accepted = 0, evaluations = 0, told = 0;
};

Walk walk(const Counted& target, const Kernel& kernel, const KernelSettings& settings) {
  constexpr int kTransitions = 2000;
  Walk walk{Eigen::MatrixXd(kTransitions, 2), 0, 0, 0};
  ChainState state = state_at(target, {Eigen::Vector2d(-0.2, 0.1), Eigen::VectorXi::Zero(1)});
  target.evaluations = 0;
  Rng rng(8);
  for (int t = 0; t < kTransitions; ++t) {
    const TransitionInfo info = kernel.step(target, settings, state, rng);
    EXPECT_EQ(state.evaluation.gradient.size(), 2);
    walk.places.row(t) = state.position.continuous.transpose();
    walk.accepted += info.accepted;
    walk.told += info.evaluations;
  }
  walk.evaluations = target.evaluations;
  return walk;
}

TEST(Value, leaving_the_gradient_out_changes_no_draw_and_saves_that_of_every_rejected_proposal) {
  const KernelSettings settings = settings_with(1, Eigen::Matrix2d::Identity());
  const auto refresh = make_refresh_move(), levels = make_single_discrete_move();
  for (const Kernel* kernel : {refresh.get(), levels.get()}) {
    const Counted lazy(true), eager(false);
    const Walk once = walk(lazy, *kernel, settings), again = walk(eager, *kernel, settings);
    EXPECT_EQ(once.places, again.places);
    EXPECT_EQ(once.evaluations, once.accepted);
    EXPECT_LT(once.evaluations, 2000);
    EXPECT_EQ(again.told, again.evaluations);
    EXPECT_EQ(once.told, 2000 + once.accepted) << "values count as evaluations";
  }
}

TEST(Value, a_gradient_that_is_not_finite_rejects_a_proposal_whose_value_was_accepted) {
  const Counted target(true, 0.3);
  const auto refresh = make_refresh_move();
  const Walk walked = walk(target, *refresh, settings_with(1, Eigen::Matrix2d::Identity()));
  EXPECT_LE(walked.places.col(0).maxCoeff(), 0.3);
  EXPECT_LT(walked.accepted, walked.evaluations) << "some were turned back";
}

}  // namespace
}  // namespace patina
