#include "engine/run/emulated_proposals.h"

#include <gtest/gtest.h>

#include <utility>

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

}  // namespace
}  // namespace patina
