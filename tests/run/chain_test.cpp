#include "engine/run/chain.h"

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <thread>

#include "engine/run/chain_start.h"
#include "engine/run/controlled_density.h"
#include "engine/run/summarize.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

using namespace std::chrono_literals;

/// N(mean, covariance) in two dimensions, with a hook that every evaluation runs first.
class Gaussian final : public LogDensity {
 public:
  Eigen::Vector2d mean{1, -2};
  Eigen::Matrix2d covariance{{1, 0.8 * 3}, {0.8 * 3, 9}};
  std::function<void()> before;

  Eigen::Index dimension() const override { return 2; }
  Evaluation evaluate(const Position& position) const override {
    if (before) before();
    const Eigen::VectorXd pull = -covariance.inverse() * (position.continuous - mean);
    return {0.5 * (position.continuous - mean).dot(pull), pull};
  }
};

/// Chains on a Gaussian, as a run would make them.
class ChainTest : public FolderTest {
 protected:
  ChainTest() {
    settings_.chains = 3;
    settings_.warmup = 300;
    settings_.draws = 1500;
    settings_.material = "gaussian";
    table_.material = "gaussian";
    table_.continuous = {{"x", "", "", {0, 1, -100, 100}}, {"y", "", "", {0, 1, -100, 100}}};
  }

  /// Runs all chains to their end in a fresh folder; all draws in the order in which they were queued.
  std::vector<Draw> run(RunShared& shared, const std::string& name = "run") {
    const ControlledDensity target(target_, shared.control);
    const auto kernel = make_kernel("mala", target, 0.8);
    const Position mode{target_.mean, Eigen::VectorXi()};
    directory_ = folder_ / name;
    std::filesystem::create_directory(directory_);
    const ChainPlan plan{settings_,
                         table_,
                         target,
                         *kernel,
                         [](const Position& p) {
                           return ParameterValues{{p.continuous.begin(), p.continuous.end()}, {}};
                         },
                         {mode, Gaussian().evaluate(mode)},
                         std::make_shared<const Metric>(target_.covariance),
                         MetricKind::dense,
                         directory_};
    shared.edit_status([&](RunStatus& status) { status.chains.resize(3); });
    WarmupMeeting meeting(3, plan.metric);
    std::deque<Chain> chains;
    for (int k = 0; k < 3; ++k) chains.emplace_back(plan, meeting, shared, k);
    std::vector<std::jthread> threads;
    for (Chain& chain : chains)
      threads.emplace_back([&] {
        chain.warm_up();
        chain.sample(*kernel);
      });
    threads.clear();
    return shared.draws.take_all();
  }

  static std::vector<Draw> sorted(std::vector<Draw> draws) {
    std::ranges::sort(draws, {}, [](const Draw& d) { return std::pair(d.chain, d.iteration); });
    return draws;
  }

  RunSettings settings_;
  ParameterTable table_;
  Gaussian target_;
  std::filesystem::path directory_;
};

TEST_F(ChainTest, ChainsFindTheTargetsMoments) {
  RunShared shared({});
  const RunSummary summary = summarize_draws(table_, run(shared));
  EXPECT_EQ(shared.failure(), "");
  for (int i = 0; i < 2; ++i) {
    const QuantitySummary& q = summary.quantities[static_cast<std::size_t>(i) + 1];
    EXPECT_NEAR(q.mean, target_.mean[i], 5 * q.mcse_mean);
    EXPECT_NEAR(q.sd, std::sqrt(target_.covariance(i, i)), 5 * q.mcse_sd);
    EXPECT_LT(q.rhat, 1.02);
    EXPECT_GT(q.bulk_ess, 500);
  }
}

TEST_F(ChainTest, DrawsDoNotDependOnTheTimingOfTheThreads) {
  settings_.draws = 100;
  RunShared first({}), second({});
  const std::vector<Draw> a = sorted(run(first, "a"));
  std::atomic<unsigned> counter{0};
  target_.before = [&] {
    if (++counter % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(counter % 5 * 100));
  };
  const std::vector<Draw> b = sorted(run(second, "b"));
  ASSERT_EQ(a.size(), 3u * 400);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].values, b[i].values) << i;
    ASSERT_EQ(a[i].step_size, b[i].step_size) << i;
  }
}

TEST_F(ChainTest, NothingAdaptsAfterWarmUp) {
  RunShared shared({});
  std::vector<double> steps;
  for (const Draw& draw : sorted(run(shared)))
    if (!draw.warmup && draw.chain == 0) steps.push_back(draw.step_size);
  EXPECT_EQ(std::ranges::count(steps, steps.front()), settings_.draws);
}

TEST_F(ChainTest, ARejectedProposalRepeatsTheDraw) {
  RunShared shared({});
  const std::vector<Draw> draws = sorted(run(shared));
  double accepted = 0, moved = 0;
  for (std::size_t i = 1; i < draws.size(); ++i) {
    if (draws[i].warmup || draws[i].chain != draws[i - 1].chain) continue;
    accepted += draws[i].accept_stat;
    moved += !(draws[i].values == draws[i - 1].values);
  }
  EXPECT_LT(moved, 0.95 * 3 * settings_.draws);
  EXPECT_NEAR(moved / accepted, 1, 0.05);
}

TEST_F(ChainTest, ATargetThatThrowsEndsAllChainsWithItsReasonAndWholeFiles) {
  RunShared shared({});
  std::atomic<int> evaluations{0}, late{0};
  target_.before = [&] {
    if (!shared.failure().empty()) ++late;
    if (++evaluations == 500) throw std::runtime_error("out of memory\nsecond line");
  };
  const std::vector<Draw> draws = run(shared);
  EXPECT_EQ(shared.failure(), "out of memory");
  std::size_t rows = 0;
  for (int k = 1; k <= 3; ++k) {
    ChainCsvReader reader(directory_ / ("chain-" + std::to_string(k) + ".csv"));
    rows += reader.read_new().size();
    EXPECT_TRUE(reader.closed());
  }
  EXPECT_EQ(rows, draws.size());
  // The other two may each have been on the way into an evaluation when the reason was put down.
  EXPECT_LE(late, 2);
}

TEST_F(ChainTest, WithoutWarmUpEveryRowIsADraw) {
  settings_.warmup = 0;
  settings_.draws = 50;
  RunShared shared({});
  const std::vector<Draw> draws = run(shared);
  EXPECT_EQ(draws.size(), 150u);
  EXPECT_TRUE(std::ranges::none_of(draws, &Draw::warmup));
  ChainCsvReader reader(directory_ / "chain-1.csv");
  for (const auto& row : reader.read_new()) EXPECT_FALSE(row.warmup);
}

/// A ridge bent along a parabola, x1 = x0^2 / 4 to within 0.02, of which nothing but the prior says how far.
class BentRidge final : public LogDensity {
 public:
  Eigen::Index dimension() const override { return 2; }
  Evaluation evaluate(const Position& p) const override {
    const double x = p.continuous[0], off = (p.continuous[1] - x * x / 4) / 0.02;
    return {-0.5 * (p.continuous.squaredNorm() + off * off),
            Eigen::Vector2d(-x + off / 0.02 * x / 2, -p.continuous[1] - off / 0.02)};
  }
};

TEST(OverdispersedStart, KeepsThePriorsSpreadAlongABentRidgeAndClimbsOntoIt) {
  const BentRidge target;
  const Position mode{Eigen::Vector2d::Zero(), Eigen::VectorXi()};
  const Metric laplace(Eigen::Vector2d(1, 4e-4).asDiagonal().toDenseMatrix());
  constexpr int kStarts = 2000;
  Rng rng(3);
  double along = 0;
  for (int i = 0; i < kStarts; ++i) {
    const ChainState start = overdispersed_start(target, {mode, target.evaluate(mode)}, laplace, rng);
    along += start.position.continuous[0] * start.position.continuous[0] / kStarts;
    ASSERT_EQ(start.evaluation.log_density, target.evaluate(start.position).log_density);
    ASSERT_GT(start.evaluation.log_density, -8.01) << "a chi-square's mean of 2, and three times its sd of 2";
  }
  EXPECT_GT(along, 0.6);
  EXPECT_LT(along, 1.6);
}

/// Half of the plane has no density.
class HalfPlane final : public LogDensity {
 public:
  Eigen::Index dimension() const override { return 2; }
  Evaluation evaluate(const Position& p) const override {
    if (p.continuous[0] < 0) return {-INFINITY, Eigen::VectorXd::Zero(2)};
    return {-0.5 * p.continuous.squaredNorm(), -p.continuous};
  }
};

TEST(OverdispersedStart, NeverHasAnInfiniteDensity) {
  const HalfPlane target;
  const Position mode{Eigen::Vector2d::Zero(), Eigen::VectorXi()};
  Rng rng(3);
  for (int i = 0; i < 500; ++i)
    ASSERT_TRUE(
        std::isfinite(overdispersed_start(target, {mode, target.evaluate(mode)}, Metric::identity(2), rng)
                          .evaluation.log_density));
}

/// Three levels of which the first is far better than the others.
class OneGoodLevel final : public LogDensity {
 public:
  double penalty = 0;
  Eigen::Index dimension() const override { return 1; }
  std::vector<int> discrete_levels() const override { return {3}; }
  Evaluation evaluate(const Position& p) const override {
    return {-0.5 * p.continuous.squaredNorm() - (p.discrete[0] == 0 ? 0 : penalty), -p.continuous};
  }
};

TEST(OverdispersedStart, SpreadsOverLevelsUnlessTheyAreHopeless) {
  OneGoodLevel target;
  const Position mode{Eigen::VectorXd::Zero(1), Eigen::VectorXi::Zero(1)};
  Rng rng(3);
  const auto other_levels = [&] {
    int others = 0;
    for (int i = 0; i < 300; ++i)
      others += overdispersed_start(target, {mode, target.evaluate(mode)}, Metric::identity(1), rng)
                    .position.discrete[0] != 0;
    return others;
  };
  EXPECT_NEAR(other_levels(), 200, 50);
  target.penalty = 1e4;
  EXPECT_EQ(other_levels(), 0);
}

}  // namespace
}  // namespace patina
