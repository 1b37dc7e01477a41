#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/sampling/function_density.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/leapfrog.h"
#include "engine/sampling/metropolis.h"
#include "tests/sampling/skewed_target.h"
#include "tests/sampling/statistics.h"

// A kernel that leaves its target invariant turns exact draws into exact draws. No burn-in, no
// autocorrelation: the states after k transitions are independent, and every Kolmogorov distance has a bound
// that holds for certain.

namespace patina {
namespace {

constexpr int kDraws = 40000;
constexpr double kFamilyWiseAlpha = 1e-6;

struct Marginal {
  std::string name;
  std::function<double(const SkewedTarget::Independent&, int level)> value;
  std::function<double(double)> cdf;
};

/// Functions of the draw whose distributions are known: e^a, e^b are Exp(1), their sum Gamma(2), their share
/// of it uniform, their minimum Exp(2).
std::vector<Marginal> marginals() {
  using Parts = SkewedTarget::Independent;
  const auto exponential = [](double e) { return -std::expm1(-e); };
  const auto uniform = [](double p) { return p; };
  return {
      {"a", [](const Parts& p, int) { return std::exp(p.a); }, exponential},
      {"b", [](const Parts& p, int) { return std::exp(p.b); }, exponential},
      {"t", [](const Parts& p, int) { return p.t; }, [](double t) { return t * t; }},
      {"sum", [](const Parts& p, int) { return std::exp(p.a) + std::exp(p.b); },
       [](double s) { return 1 - std::exp(-s) * (1 + s); }},
      {"share", [](const Parts& p, int) { return 1 / (1 + std::exp(p.b - p.a)); }, uniform},
      {"minimum", [](const Parts& p, int) { return std::exp(std::min(p.a, p.b)); },
       [](double e) { return -std::expm1(-2 * e); }},
      // Levels as uniforms: level k spread over its interval by the fractional part of another uniform.
      {"level",
       [](const Parts& p, int k) {
         const double low[] = {0, 0.5, 0.8};
         return low[k] + SkewedTarget::kLevelWeights[k] * p.t * p.t;
       },
       uniform},
  };
}

struct Outcome {
  double worst =
      0;  ///< largest Kolmogorov distance in units of its bound: above 1 the family of tests rejects
  std::string worst_name;
  double accepted = 0;
  double moved = 0;  ///< mean distance from the start
};

Outcome after_transitions(const Kernel& kernel, const LogDensity& target, int transitions,
                          std::shared_ptr<const Straightening> straightening = nullptr) {
  KernelSettings settings = settings_with(0.8, some_covariance(3));
  settings.straightening = std::move(straightening);
  Rng rng(31);
  std::vector<Position> ends;
  Outcome outcome;
  for (int i = 0; i < kDraws; ++i) {
    const Position start = SkewedTarget::exact_draw(rng);
    ChainState state = state_at(target, start);
    for (int k = 0; k < transitions; ++k)
      outcome.accepted += kernel.step(target, settings, state, rng).accepted / double(kDraws * transitions);
    outcome.moved += (state.position.continuous - start.continuous).norm() / kDraws;
    ends.push_back(state.position);
  }
  for (const Marginal& marginal : marginals()) {
    std::vector<double> sample;
    for (const Position& end : ends)
      sample.push_back(marginal.value(SkewedTarget::independent(end), end.discrete[0]));
    const double bound = testing_statistics::dkw_bound(kDraws, kFamilyWiseAlpha / marginals().size());
    const double distance = testing_statistics::ks_distance(sample, marginal.cdf) / bound;
    if (distance > outcome.worst) outcome.worst = distance, outcome.worst_name = marginal.name;
  }
  return outcome;
}

/// A refresh move that forgets the N(0, 1) of its proposals: a plausible mistake.
class RefreshWithoutProposalTerm final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings&, ChainState& state,
                      Rng& rng) const override {
    Position position = state.position;
    position.continuous[rng.below(3)] = rng.normal();
    ChainState proposal = state_at(target, position);
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density;
    return metropolis_step(MoveKind::refresh, log_ratio, 1e9, std::move(proposal), state, rng);
  }
  double target_acceptance() const override { return 0; }
};

/// Follows a path and stays at its end, whatever the energy there: a plausible mistake.
class PathWithoutDecision final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    PhasePoint point{state, rng.normals(3)};
    for (int i = 0; i < 2; ++i) leapfrog(target, *settings.metric, 1.5 * settings.step_size, point);
    state = point.state;
    return {};
  }
  double target_acceptance() const override { return 0.8; }
};

/// MALA that forgets the proposals in its ratio: a plausible mistake.
class MalaWithoutReverseProposal final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    const double step = settings.step_size;
    Position position = state.position;
    position.continuous += step * step / 2 * settings.metric->multiply(state.evaluation.gradient) +
                           step * settings.metric->colour(rng.normals(3));
    ChainState proposal = state_at(target, position);
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density;
    return metropolis_step(MoveKind::continuous, log_ratio, 1000, std::move(proposal), state, rng);
  }
  double target_acceptance() const override { return 0.574; }
};

TEST(Invariance, every_kernel_keeps_exact_draws_exact) {
  const SkewedTarget target;
  for (const std::string& name : kernel_names()) {
    const Outcome outcome = after_transitions(*make_kernel(name, target, 1), target, 3);
    EXPECT_LT(outcome.worst, 1) << name << ": " << outcome.worst_name;
    EXPECT_GT(outcome.moved, 0.2) << name;
    EXPECT_GT(outcome.accepted, 0.3) << name;
    // A trajectory of NUTS is hardly ever all bad.
    EXPECT_LT(outcome.accepted, name == "nuts" ? 1 : 0.995) << name;
  }
}

/// HMC that weighs the potential energy alone: a plausible mistake.
class HmcWithoutKineticEnergy final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    PhasePoint point{state, rng.normals(3)};
    for (int i = 0; i < 2; ++i) leapfrog(target, *settings.metric, settings.step_size, point);
    const double log_ratio = point.state.evaluation.log_density - state.evaluation.log_density;
    return metropolis_step(MoveKind::continuous, log_ratio, 1e9, std::move(point.state), state, rng);
  }
  double target_acceptance() const override { return 0.65; }
};

TEST(Invariance, is_lost_without_the_kinetic_energy) {
  EXPECT_GT(after_transitions(HmcWithoutKineticEnergy(), SkewedTarget(), 3).worst, 1);
}

TEST(Invariance, refresh_moves_keep_exact_draws_exact) {
  const Outcome outcome = after_transitions(*make_refresh_move(), SkewedTarget(), 5);
  EXPECT_LT(outcome.worst, 1) << outcome.worst_name;
  EXPECT_GT(outcome.moved, 0.2);
  EXPECT_LT(outcome.accepted, 0.99);
}

TEST(Invariance, walks_of_all_scales_keep_exact_draws_exact) {
  const Outcome outcome = after_transitions(*make_walk_of_all_scales(), SkewedTarget(), 5);
  EXPECT_LT(outcome.worst, 1) << outcome.worst_name;
  EXPECT_GT(outcome.moved, 0.2);
  EXPECT_LT(outcome.accepted, 0.99);
}

TEST(Invariance, mirror_moves_keep_exact_draws_exact) {
  for (const Eigen::Index coordinate : {0, 1}) {
    const Outcome outcome = after_transitions(*make_mirror_move(coordinate), SkewedTarget(), 5);
    EXPECT_LT(outcome.worst, 1) << outcome.worst_name;
    EXPECT_GT(outcome.moved, 0.2);
    EXPECT_LT(outcome.accepted, 0.99);
  }
}

TEST(Invariance, is_lost_when_a_refresh_forgets_its_proposal) {
  EXPECT_GT(after_transitions(RefreshWithoutProposalTerm(), SkewedTarget(), 5).worst, 1);
}

TEST(Invariance, discrete_moves_keep_exact_draws_exact) {
  const Outcome outcome = after_transitions(*make_discrete_move(), SkewedTarget(), 3);
  EXPECT_LT(outcome.worst, 1) << outcome.worst_name;
  EXPECT_LT(outcome.accepted, 0.95);
}

TEST(Invariance, the_mixture_keeps_exact_draws_exact) {
  const SkewedTarget target;
  for (const std::string& name : kernel_names())
    for (const double alpha : {0.3, 0.8}) {
      const Outcome outcome = after_transitions(*make_kernel(name, target, alpha, 0.3), target, 3);
      EXPECT_LT(outcome.worst, 1) << outcome.worst_name << " with " << name << " at alpha " << alpha;
      EXPECT_GT(outcome.moved, 0.15) << name;
    }
}

/// Bends the first two coordinates of SkewedTarget along the third, where they are straight, and widens them.
std::shared_ptr<const Straightening> some_straightening() {
  Straightening::Coefficients coefficients{Eigen::MatrixXd::Zero(4, 3), Eigen::MatrixXd::Zero(4, 3)};
  coefficients.middle.col(0) << 0.3, -0.4, 0.8, -0.5;
  coefficients.middle.col(1) << 0.1, 0.5, -0.9, 0.4;
  coefficients.log_width.col(0) << 0.2, 0.3, -0.4, 0.1;
  coefficients.log_width.col(1) << -0.2, -0.3, 0.2, 0.2;
  return std::make_shared<const Straightening>(2, NaturalSplineBasis(Eigen::Vector4d(-1, 0, 1, 3)),
                                               coefficients);
}

TEST(Invariance, holds_in_straightened_coordinates) {
  const SkewedTarget target;
  for (const std::string& name : kernel_names()) {
    const auto kernel = make_kernel(name, target, 0.8, 0.3);
    const Outcome outcome = after_transitions(*kernel, target, 3, some_straightening());
    EXPECT_LT(outcome.worst, 1) << outcome.worst_name << " with " << name;
    EXPECT_GT(outcome.moved, 0.15) << name;
    EXPECT_NE(outcome.moved, after_transitions(*kernel, target, 3).moved) << "the map was not used";
  }
}

/// Steps in straightened coordinates and forgets to bend them back: a plausible mistake.
class StraightenedForGood final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    const TransitionInfo info = kernel_->step(target, settings, state, rng);
    if (info.accepted)
      state = state_at(
          target, {settings.straightening->straighten(state.position.continuous), state.position.discrete});
    return info;
  }
  double target_acceptance() const override { return 0.65; }

 private:
  std::unique_ptr<Kernel> kernel_ = make_straightened(make_hmc());
};

TEST(Invariance, is_lost_when_coordinates_are_not_bent_back) {
  EXPECT_GT(after_transitions(StraightenedForGood(), SkewedTarget(), 3, some_straightening()).worst, 1);
}

TEST(Invariance, is_lost_without_the_reverse_proposal) {
  EXPECT_GT(after_transitions(MalaWithoutReverseProposal(), SkewedTarget(), 5).worst, 1);
}

TEST(Invariance, is_lost_without_a_decision_at_the_end_of_a_path) {
  EXPECT_GT(after_transitions(PathWithoutDecision(), SkewedTarget(), 8).worst, 1);
}

/// SkewedTarget seen badly: bent, tilted, and with other weights of levels.
FunctionDensity poor_likeness() {
  return {3,
          [](const Position& p) {
            Evaluation evaluation = SkewedTarget().evaluate(p);
            const Eigen::VectorXd& x = p.continuous;
            evaluation.log_density +=
                0.5 * std::sin(x[0]) + 0.3 * x[1] - 0.05 * x[2] * x[2] + 0.4 * p.discrete[0];
            evaluation.gradient += Eigen::Vector3d(0.5 * std::cos(x[0]), 0.3, -0.1 * x[2]);
            return evaluation;
          },
          {3}};
}

TEST(Invariance, holds_where_a_poor_likeness_of_the_target_proposes) {
  const SkewedTarget target;
  const FunctionDensity cheap = poor_likeness();
  for (const char* name : {"mh", "mala", "hmc"})
    for (const int moves : {1, 4}) {
      const auto kernel = make_two_stage(make_kernel(name, cheap, 0.7, 0.3), cheap, moves);
      const Outcome outcome = after_transitions(*kernel, target, 2);
      EXPECT_LT(outcome.worst, 1) << outcome.worst_name << " with " << name << ", " << moves;
      EXPECT_GT(outcome.moved, 0.2) << name;
      EXPECT_LT(outcome.accepted, 0.95) << name;
    }
}

/// Goes where a likeness of the target leads and asks nobody: a plausible mistake.
class OneStage final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    ChainState there = state_at(cheap_, state.position);
    for (int i = 0; i < 4; ++i) kernel_->step(cheap_, settings, there, rng);
    state = state_at(target, there.position);
    return {};
  }
  double target_acceptance() const override { return 0.65; }

 private:
  FunctionDensity cheap_ = poor_likeness();
  std::unique_ptr<Kernel> kernel_ = make_kernel("hmc", cheap_, 0.7, 0.3);
};

TEST(Invariance, is_lost_where_the_likeness_decides) {
  EXPECT_GT(after_transitions(OneStage(), SkewedTarget(), 2).worst, 1);
}

/// The target's own density, which is below 1, to a power, and a factor.
FunctionDensity to_a_power(double power, double log_factor) {
  return {3,
          [=](const Position& p) {
            Evaluation e = SkewedTarget().evaluate(p);
            return Evaluation{power * e.log_density + log_factor, power * e.gradient};
          },
          {3}};
}

TEST(Invariance, is_kept_by_rejection_under_a_density_that_is_nowhere_below) {
  const SkewedTarget target;
  const FunctionDensity envelope = to_a_power(0.8, 0);
  for (const char* name : {"mh", "mala", "hmc"})
    for (const int moves : {1, 4}) {
      const auto kernel = make_rejection(make_kernel(name, envelope, 0.7, 0.3), envelope, moves);
      const Outcome outcome = after_transitions(*kernel, target, 2);
      EXPECT_LT(outcome.worst, 1) << outcome.worst_name << " with " << name << ", " << moves;
      EXPECT_GT(outcome.moved, 0.5) << name;
      EXPECT_GT(outcome.accepted, 0.999) << "a place is taken in the end";
    }
}

TEST(Invariance, is_kept_where_rejection_gives_up_and_stays) {
  const FunctionDensity envelope = to_a_power(0.8, 5);
  const auto kernel = make_rejection(make_kernel("mh", envelope, 0.7, 0.3), envelope, 1);
  const Outcome outcome = after_transitions(*kernel, SkewedTarget(), 1);
  EXPECT_LT(outcome.worst, 1) << outcome.worst_name;
  EXPECT_GT(outcome.accepted, 0.05);
  EXPECT_LT(outcome.accepted, 0.5);
}

TEST(Invariance, is_lost_where_the_density_is_below_the_target) {
  const FunctionDensity below = to_a_power(0.8, -3);
  const auto kernel = make_rejection(make_kernel("hmc", below, 0.7, 0.3), below, 4);
  EXPECT_GT(after_transitions(*kernel, SkewedTarget(), 2).worst, 1);
}

TEST(Invariance, is_lost_without_the_jacobian) {
  const SkewedTarget wrong(/*with_jacobian=*/false);
  for (const char* name :
       {"mh", "mala", "hmc"})  // the wrong density is improper: trees would grow without end
    EXPECT_GT(after_transitions(*make_kernel(name, wrong, 1), wrong, 5).worst, 1) << name;
}

}  // namespace
}  // namespace patina
