#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "engine/run/chain.h"
#include "engine/run/controlled_density.h"
#include "engine/run/run_files.h"
#include "engine/run/warmup_state.h"
#include "engine/sampling/kernels.h"
#include "tests/io/folder_test.h"

namespace patina {

/// A bent ridge in two coordinates and three levels that displace it.
inline Evaluation bent_ridge(const Position& p) {
  const double x = p.continuous[0] - 0.2 * p.discrete[0], off = p.continuous[1] - x * x;
  return {-0.5 * x * x - 8 * off * off, Eigen::Vector2d(-x + 32 * off * x, -16 * off)};
}

/// A density of two coordinates and three levels, with a hook that every evaluation runs first.
class Mixed final : public LogDensity {
 public:
  std::function<void()> before;
  std::function<Evaluation(const Position&)> density = bent_ridge;

  Eigen::Index dimension() const override { return 2; }
  std::vector<int> discrete_levels() const override { return {3}; }
  Evaluation evaluate(const Position& p) const override {
    if (before) before();
    return density(p);
  }
};

/// A run's chains, warm-up meetings and state files on a target that costs nothing.
class CheapChainsTest : public FolderTest {
 protected:
  static constexpr int kChains = 3;

  CheapChainsTest() {
    settings_.chains = kChains;
    settings_.warmup = 300;  // several windows, the last of which sees that the ridge is bent
    settings_.draws = 40;
    settings_.material = "mixed";
    table_.material = "mixed";
    table_.continuous = {{"x", "", "", {0, 1, -100, 100}}, {"y", "", "", {0, 1, -100, 100}}};
    table_.discrete = {{"level", "", {"a", "b", "c"}}};
  }

  /// Takes up the run in that directory and goes on until its end or a stop.
  void take_up(RunShared& shared, const std::filesystem::path& directory) {
    const ControlledDensity target(target_, shared.control);
    const auto kernel = make_kernel("hmc", target, 0.7, 0.3);
    const Position mode{Eigen::Vector2d::Zero(), Eigen::VectorXi::Zero(1)};
    std::filesystem::create_directories(directory);
    const ChainPlan plan{settings_,
                         table_,
                         target,
                         *kernel,
                         [](const Position& p) {
                           return ParameterValues{{p.continuous.begin(), p.continuous.end()},
                                                  {p.discrete.begin(), p.discrete.end()}};
                         },
                         {mode, target_.density(mode)},
                         std::make_shared<const Metric>(Metric::identity(2)),
                         MetricKind::curved,
                         directory,
                         "key",
                         std::chrono::milliseconds(1),
                         start_};
    shared.edit_status([&](RunStatus& status) { status.chains.resize(kChains); });
    WarmupMeeting meeting(
        kChains, plan.metric, 20, {},
        [&](const WarmupRecord& record) { write_warmup(directory, "key", record); },
        read_warmup(directory, "key", target, settings_.rungs()));
    std::deque<Chain> chains;
    for (int k = 0; k < kChains; ++k) chains.emplace_back(plan, meeting, shared, k);
    std::vector<std::jthread> threads;
    for (Chain& chain : chains)
      threads.emplace_back([&] {
        chain.warm_up();
        chain.sample(*kernel);
      });
  }

  /// The same undisturbed.
  std::vector<Draw> take_up(const std::filesystem::path& directory) {
    RunShared shared({});
    take_up(shared, directory);
    EXPECT_EQ(shared.failure(), "");
    return shared.draws.take_all();
  }

  /// The chain files one after another.
  static std::string bytes_of(const std::filesystem::path& directory) {
    std::string bytes;
    for (int k = 0; k < kChains; ++k) bytes += slurp(chain_file(directory, k));
    return bytes;
  }

  RunSettings settings_;
  ParameterTable table_;
  Mixed target_;
  std::function<Position(Rng&)> start_;  ///< see ChainPlan
};

}  // namespace patina
