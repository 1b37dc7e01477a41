#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/sampling/kernels.h"
#include "engine/sampling/metropolis.h"
#include "tests/sampling/statistics.h"
#include "tests/sampling/targets.h"

// A posterior that can be enumerated: x1, x2 ~ N(0, 1); levels (i, j) of a 3 x 4 table, uniform; two data
// y ~ N(x + shift(i, j), noise^2 I). The evidence of each cell is N(y; shift, (1 + noise^2) I), and x given
// the cell is N((y - shift) / (1 + noise^2), noise^2 / (1 + noise^2) I).

namespace patina {
namespace {

constexpr double kNoise2 = 0.5;
constexpr int kCells = 12;
using Cells = std::array<double, kCells>;

Eigen::Vector2d residual(int i, int j) { return {0.8 - 0.9 * i, -0.3 + 0.5 * j - 0.4 * i}; }

FunctionDensity table_target() {
  return {
      2,
      [](const Position& position) {
        const Eigen::Vector2d x = position.continuous;
        const Eigen::Vector2d misfit = residual(position.discrete[0], position.discrete[1]) - x;
        return Evaluation{-0.5 * (x.squaredNorm() + misfit.squaredNorm() / kNoise2), misfit / kNoise2 - x};
      },
      {3, 4}};
}

Cells exact_probabilities() {
  Cells p{};
  double total = 0;
  for (int c = 0; c < kCells; ++c)
    total += p[c] = std::exp(-0.5 * residual(c / 4, c % 4).squaredNorm() / (1 + kNoise2));
  for (double& value : p) value /= total;
  return p;
}

Position exact_draw(Rng& rng) {
  double pick = rng.uniform();
  int cell = 0;
  const Cells p = exact_probabilities();
  while (cell < kCells - 1 && pick > p[cell]) pick -= p[cell++];
  const Eigen::Vector2d mean = residual(cell / 4, cell % 4) / (1 + kNoise2);
  return {mean + std::sqrt(kNoise2 / (1 + kNoise2)) * rng.normals(2), Eigen::Vector2i(cell / 4, cell % 4)};
}

/// |z| of each cell's share, and last of the mean of x1, over chains that start in equilibrium: their
/// averages are independent and unbiased whatever their autocorrelation.
std::vector<double> z_scores(const Kernel& kernel) {
  constexpr int chains = 150, transitions = 400;
  const FunctionDensity target = table_target();
  const KernelSettings settings = settings_with(0.7, Eigen::MatrixXd::Identity(2, 2));
  std::vector<std::vector<double>> shares(kCells + 1, std::vector<double>(chains));
  for (int chain = 0; chain < chains; ++chain) {
    Rng rng(41, chain);
    ChainState state = state_at(target, exact_draw(rng));
    for (int t = 0; t < transitions; ++t) {
      kernel.step(target, settings, state, rng);
      shares[state.position.discrete[0] * 4 + state.position.discrete[1]][chain] += 1.0 / transitions;
      shares[kCells][chain] += state.position.continuous[0] / transitions;
    }
  }
  const Cells p = exact_probabilities();
  double mean = 0;
  for (int c = 0; c < kCells; ++c) mean += p[c] * residual(c / 4, c % 4)[0] / (1 + kNoise2);
  std::vector<double> z;
  for (int c = 0; c <= kCells; ++c)
    z.push_back(std::abs(testing_statistics::z_score(shares[c], c < kCells ? p[c] : mean)));
  return z;
}

/// Proposes the higher levels more often and leaves the proposal probabilities out of the ratio.
class LopsidedDiscreteMove final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings&, ChainState& state,
                      Rng& rng) const override {
    Position position = state.position;
    position.discrete[0] = std::max(rng.below(3), rng.below(3));
    position.discrete[1] = rng.below(4);
    ChainState proposal = state_at(target, position);
    const double log_ratio = proposal.evaluation.log_density - state.evaluation.log_density;
    return metropolis_step(MoveKind::discrete, log_ratio, 1000, std::move(proposal), state, rng);
  }
  double target_acceptance() const override { return 0; }
};

TEST(DiscretePosterior, has_the_enumerated_probabilities_whatever_alpha) {
  for (const std::string& name : kernel_names())
    for (const double alpha : {0.1, 0.5, 0.9})
      for (const double z : z_scores(*make_kernel(name, table_target(), alpha)))
        EXPECT_LT(z, 5) << name << ", alpha " << alpha;
}

TEST(DiscretePosterior, has_the_same_probabilities_when_one_coordinate_moves_at_a_time) {
  for (const double z : z_scores(*make_kernel("mala", table_target(), 0.5, 0, "single"))) EXPECT_LT(z, 5);
}

TEST(SingleDiscreteMove, proposes_another_level_of_one_coordinate_and_leaves_those_of_one_level_alone) {
  const FunctionDensity flat(0, [](const Position&) { return Evaluation{0, Eigen::VectorXd(0)}; }, {1, 3, 2});
  const auto kernel = make_single_discrete_move();
  Rng rng(43);
  ChainState state = state_at(flat, {Eigen::VectorXd(0), Eigen::Vector3i(0, 1, 0)});
  int second = 0, ups = 0;
  constexpr int kMoves = 4000;
  for (int t = 0; t < kMoves; ++t) {
    const Eigen::VectorXi before = state.position.discrete;
    kernel->step(flat, {}, state, rng);
    const Eigen::VectorXi change = state.position.discrete - before;
    ASSERT_EQ((change.array() != 0).count(), 1);
    ASSERT_EQ(change[0], 0);
    second += change[1] != 0;
    ups += change[1] == 1 || change[1] == -2;
  }
  EXPECT_NEAR(second, kMoves / 2.0, 5 * std::sqrt(kMoves / 4.0));
  EXPECT_NEAR(ups, second / 2.0, 5 * std::sqrt(second / 4.0)) << "both other levels alike";
}

TEST(DiscretePosterior, is_missed_by_lopsided_proposals) {
  const auto kernel = make_mixture(make_mala(), std::make_unique<LopsidedDiscreteMove>(), 0.5);
  const std::vector<double> z = z_scores(*kernel);
  EXPECT_GT(*std::max_element(z.begin(), z.end()), 5);
}

TEST(DiscretePosterior, the_mixture_moves_continuously_with_probability_alpha) {
  const FunctionDensity target = table_target();
  const auto kernel = make_kernel("mala", target, 0.8);
  Rng rng(42);
  ChainState state = state_at(target, exact_draw(rng));
  const KernelSettings settings = settings_with(0.7, Eigen::MatrixXd::Identity(2, 2));
  int continuous = 0;
  constexpr int transitions = 20000;
  for (int t = 0; t < transitions; ++t)
    continuous += kernel->step(target, settings, state, rng).move == MoveKind::continuous;
  EXPECT_NEAR(continuous, 0.8 * transitions, 5 * std::sqrt(transitions * 0.8 * 0.2));
}

}  // namespace
}  // namespace patina
