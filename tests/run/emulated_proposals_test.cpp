#include "engine/run/emulated_proposals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "engine/run/chain_start.h"
#include "engine/sampling/function_density.h"

namespace patina {
namespace {

std::vector<std::pair<int, std::size_t>> moves(const std::vector<std::vector<double>>& log_densities) {
  std::vector<std::pair<int, std::size_t>> result;
  for (const ChainIteration& move : moves_of_warmup(log_densities))
    result.emplace_back(move.chain, move.iteration);
  return result;
}

TEST(MovesOfWarmup, AreWhereChainsCameToOnceEachAndSideBySideInTime) {
  using Moves = std::vector<std::pair<int, std::size_t>>;
  EXPECT_EQ(moves({{-3, -3, -2, -3}, {-5, -4, -4, -4}}), (Moves{{0, 0}, {1, 0}, {1, 1}, {0, 2}, {0, 3}}));
}

TEST(MovesOfWarmup, OfChainsThatWereStoppedAreOfWhatThereIs) {
  EXPECT_TRUE(moves({{}, {}}).empty());
  EXPECT_EQ(moves({{}, {-1, -2}}).size(), 2u);
}

double distance(const ChainState& a, const ChainState& b) {
  return (a.position.continuous - b.position.continuous).norm();
}

/// Of each but the first `kept` ones to the nearest of those before it.
std::vector<double> distances_to_those_before(const std::vector<ChainState>& states, std::size_t kept) {
  std::vector<double> result;
  for (std::size_t i = kept; i < states.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, distance(states[i], states[j]));
    result.push_back(nearest);
  }
  return result;
}

TEST(EmulatorStarts, AreTheBasinsAndThenThoseThatLieFurthestApart) {
  const FunctionDensity target(3, [](const Position& position) {
    return Evaluation{-position.continuous.squaredNorm() / 2, -position.continuous};
  });
  const ChainState mode{{Eigen::VectorXd::Zero(3), {}}, target.evaluate({Eigen::VectorXd::Zero(3), {}})};
  const Metric laplace = Metric::identity(3);
  const Position aside{Eigen::Vector3d(1, 1, 1), {}};
  const std::vector<ChainState> basins{mode, {aside, target.evaluate(aside)}};
  const std::vector<ChainState> starts = emulator_starts(target, target, mode, basins, laplace, 5, 2, {});
  ASSERT_EQ(starts.size(), static_cast<std::size_t>(kEmulatorWalkers));
  EXPECT_EQ(distance(starts[0], basins[0]), 0);
  EXPECT_EQ(distance(starts[1], basins[1]), 0);
  EXPECT_TRUE(std::ranges::is_sorted(distances_to_those_before(starts, 2), std::greater<>()));

  std::vector<ChainState> as_they_come = basins;
  for (std::uint64_t i = 2; i < starts.size(); ++i) {
    Rng rng(5, i);
    as_they_come.push_back(overdispersed_start(target, mode, laplace, rng));
  }
  EXPECT_FALSE(std::ranges::is_sorted(distances_to_those_before(as_they_come, 2), std::greater<>()));
  const double apart = distances_to_those_before(starts, 2).back();
  EXPECT_GT(apart, std::ranges::min(distances_to_those_before(as_they_come, 2)));
}

}  // namespace
}  // namespace patina
