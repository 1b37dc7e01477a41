#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "engine/diagnostics/convergence.h"
#include "tests/run/cheap_chains.h"

namespace patina {
namespace {

const Eigen::Vector2d kModes[] = {{-1.5, -1}, {1.2, 1.3}};
constexpr double kWidth = 0.1, kWeights[] = {0.3, 0.7};

/// A prior N(0, I), and a likelihood that is a sum of two narrow Gaussians far apart: so is the posterior.
Evaluation two_modes(const Position& p) {
  const Eigen::Vector2d x = p.continuous;
  double logs[2];
  for (int k = 0; k < 2; ++k)
    logs[k] = std::log(kWeights[k]) - 0.5 * (x - kModes[k]).squaredNorm() / (kWidth * kWidth);
  const double top = std::max(logs[0], logs[1]), sum = std::exp(logs[0] - top) + std::exp(logs[1] - top);
  Eigen::VectorXd gradient = -x;
  for (int k = 0; k < 2; ++k) gradient -= std::exp(logs[k] - top) / sum * (x - kModes[k]) / (kWidth * kWidth);
  return {-0.5 * x.squaredNorm() + top + std::log(sum), std::move(gradient)};
}

/// Posterior probability of the first mode: prior predictive density of each, N(mode; 0, (1 + width^2) I).
double first_modes_weight() {
  double weights[2];
  for (int k = 0; k < 2; ++k)
    weights[k] = kWeights[k] * std::exp(-0.5 * kModes[k].squaredNorm() / (1 + kWidth * kWidth));
  return weights[0] / (weights[0] + weights[1]);
}

/// Chains that all start in the first mode.
class TemperedChain : public CheapChainsTest {
 protected:
  TemperedChain() {
    target_.density = two_modes;
    start_ = [](Rng&) { return Position{kModes[0], Eigen::VectorXi::Zero(1)}; };
  }

  /// Of the draws after warm-up, [draws, chains]: 1 in the first mode, else 0.
  Eigen::MatrixXd in_first_mode(const std::vector<Draw>& draws) const {
    Eigen::MatrixXd first(settings_.draws, kChains);
    for (const Draw& draw : draws)
      if (!draw.warmup)
        first(draw.iteration - settings_.warmup.value(), draw.chain) = draw.values.continuous[0] < 0;
    return first;
  }

  /// What a chain file says that its transitions have evaluated.
  std::int64_t evaluations_of(int chain) const {
    std::int64_t sum = 0;
    ChainCsvReader reader(chain_file(folder_, chain));
    for (const ChainCsvReader::Row& row : reader.read_new()) sum += row.row.n_leapfrog;
    return sum;
  }
};

TEST_F(TemperedChain, WeighsTwoModesOfWhichChainsByThemselvesSeeTheOneThatTheyStartIn) {
  settings_.warmup = 500;
  settings_.draws = 3000;
  EXPECT_EQ(in_first_mode(take_up(folder_ / "plain")).minCoeff(), 1) << "or this shows nothing";
  settings_.temper = 10;
  const Eigen::MatrixXd first = in_first_mode(take_up(folder_ / "tempered"));
  EXPECT_LT(mcse_mean(first), 0.04);
  EXPECT_LT(std::abs(first.mean() - first_modes_weight()) / mcse_mean(first), 4);
}

TEST_F(TemperedChain, ItsRowsAreTheTargetsAndCountTheEvaluationsOfAllRungs) {
  settings_.temper = 5;
  settings_.warmup = 0;
  std::atomic<std::int64_t> evaluations{0};
  target_.before = [&] { ++evaluations; };
  const std::vector<Draw> draws = take_up(folder_);
  target_.before = {};
  std::int64_t told = 0;
  for (int k = 0; k < kChains; ++k) told += evaluations_of(k);
  EXPECT_EQ(told + kChains * settings_.temper, evaluations) << "beside the starts";
  for (const Draw& draw : draws) {
    const Eigen::Vector2d x(draw.values.continuous[0], draw.values.continuous[1]);
    ASSERT_NEAR(draw.lp, two_modes({x, {}}).log_density, 1e-9);
  }
}

TEST_F(TemperedChain, StopsWithinAnEvaluation) {
  settings_.temper = 5;
  RunShared shared({});
  std::atomic<int> evaluations{0}, late{0};
  target_.before = [&] {
    if (++evaluations > 3000) ++late;
    if (evaluations == 3000) shared.control.stop();
  };
  take_up(shared, folder_);
  EXPECT_EQ(shared.failure(), "");
  EXPECT_GE(evaluations, 3000);
  // The other chains may each have been on the way into an evaluation.
  EXPECT_LT(late, kChains);
}

TEST_F(TemperedChain, TheLadderIsMovedWhereSwapsAreRejected) {
  settings_.temper = 5;
  target_.density = [](const Position& p) {
    const Eigen::Vector2d off = p.continuous - kModes[0];
    return Evaluation{-0.5 * p.continuous.squaredNorm() - 0.5 * off.squaredNorm() / (kWidth * kWidth),
                      -p.continuous - off / (kWidth * kWidth)};
  };
  take_up(folder_);
  const WarmupRecord record = read_warmup(folder_, "key", target_, settings_.temper);
  ASSERT_GT(record.size(), 1u);
  EXPECT_NE(record.begin()->second.betas, first_ladder(settings_.temper));
  const auto& last = record.rbegin()->second;
  EXPECT_LT(last.rungs.back().metric->covariance().trace(),
            0.1 * last.rungs.front().metric->covariance().trace())
      << "every rung has a metric of its own";
}

}  // namespace
}  // namespace patina
