#include <gtest/gtest.h>

#include <random>

#include "gui/plot/pair_grids.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

using testing::draw_at;
using testing::small_table;
using Clock = PairGrids::Clock;

constexpr auto kNoHurry = std::chrono::minutes(1);

std::vector<Draw> cloud(int count, unsigned seed) {
  std::mt19937 rng(seed);
  std::normal_distribution<double> normal;
  std::vector<Draw> draws;
  for (int i = 0; i < count; ++i) {
    draws.push_back(draw_at(normal(rng), normal(rng), -normal(rng) * normal(rng), i % 7 == 0, i % 3, i % 2));
  }
  return draws;
}

PairGrids::Part whole(const PairGrids& grids) { return {0, grids.size(), 0, grids.size()}; }

void count_all(PairGrids& grids, const ExplorerModel& model) {
  grids.follow(model, 1);
  ASSERT_TRUE(grids.advance(model, whole(grids), Clock::now() + kNoHurry));
}

/// The draws of a bin, counted one by one; `dimmed` those that are beneath notice.
double count_by_hand(const PairGrids& grids, const ExplorerModel& model, std::size_t row, std::size_t column,
                     int bin_up, int bin_across, bool dimmed) {
  const auto bin = [&](std::size_t axis, std::size_t draw) {
    const PlotRange range = grids.range(axis);
    return std::floor((model.draws().place(grids.axis(axis), draw) - range.low) / range.span() *
                      PairGrids::kBins);
  };
  int count = 0;
  for (std::size_t draw = 0; draw < model.draws().size(); ++draw) {
    const bool is_dimmed =
        model.draws().warmup(draw) || (!model.marked().empty() && !model.marked().contains(draw));
    count += is_dimmed == dimmed && model.visible(draw) && bin(row, draw) == bin_up &&
             bin(column, draw) == bin_across;
  }
  return count;
}

void expect_counts_by_hand(const PairGrids& grids, const ExplorerModel& model) {
  for (std::size_t row = 1; row < grids.size(); ++row) {
    for (std::size_t column = 0; column < row; ++column) {
      const DensityCells& cells = grids.cells(row, column);
      for (int i = 0; i < 40; ++i) {
        const int up = (7 * i) % PairGrids::kBins, across = (13 * i + 5) % PairGrids::kBins;
        ASSERT_EQ(cells.sums.at(PairGrids::kBins - 1 - up, across, 3),
                  count_by_hand(grids, model, row, column, up, across, false));
        ASSERT_EQ(cells.dimmed.at(PairGrids::kBins - 1 - up, across, 0),
                  count_by_hand(grids, model, row, column, up, across, true));
      }
    }
  }
}

TEST(PairGrids, HaveACellForEveryPairOfParametersAndTheMatchAndCountEveryDraw) {
  ExplorerModel model(small_table());
  model.append(cloud(3000, 1));
  PairGrids grids;
  count_all(grids, model);
  ASSERT_EQ(grids.size(), 4u);
  expect_counts_by_hand(grids, model);
}

TEST(PairGrids, CountWhatArrivesAndBeginAnewWhereTheViewGrowsOrMarksChange) {
  ExplorerModel model(small_table());
  PairGrids grids;
  model.append(cloud(500, 2));
  count_all(grids, model);
  model.append(cloud(300, 3));
  count_all(grids, model);
  expect_counts_by_hand(grids, model);
  model.append(std::vector{draw_at(20, 0.1, -1)});
  count_all(grids, model);
  expect_counts_by_hand(grids, model);
  EXPECT_GT(grids.range(0).high, 20);
  model.mark(DrawSet::of(100, [](std::size_t draw) { return draw % 5 == 0; }), Marking::replace);
  count_all(grids, model);
  expect_counts_by_hand(grids, model);
  model.hide_warmup(true);
  count_all(grids, model);
  expect_counts_by_hand(grids, model);
}

TEST(PairGrids, AreTheSameWhetherCountedAtOnceOrInManyFrames) {
  ExplorerModel model(small_table());
  model.append(cloud(100'000, 4));
  PairGrids at_once, in_parts;
  count_all(at_once, model);
  in_parts.follow(model, 1);
  int frames = 1;
  while (!in_parts.advance(model, whole(in_parts), Clock::now() + std::chrono::microseconds(300))) ++frames;
  EXPECT_GT(frames, 2);
  for (std::size_t row = 1; row < 4; ++row) {
    for (std::size_t column = 0; column < row; ++column) {
      EXPECT_EQ(in_parts.cells(row, column).sums.pixels, at_once.cells(row, column).sums.pixels);
      EXPECT_EQ(in_parts.counted(row, column), 100'000u);
    }
  }
}

TEST(PairGrids, CountOnlyWhatIsLookedAt) {
  ExplorerModel model(small_table());
  model.append(cloud(1000, 5));
  PairGrids grids;
  grids.follow(model, 1);
  EXPECT_TRUE(grids.advance(model, {2, 3, 0, 1}, Clock::now() + kNoHurry));
  EXPECT_EQ(grids.counted(2, 0), 1000u);
  EXPECT_EQ(grids.counted(1, 0), 0u);
  EXPECT_EQ(grids.counted(2, 1), 0u);
}

TEST(PairGrids, BarsCountTheAnswerAlone) {
  ExplorerModel model(small_table());
  model.append(cloud(700, 6));
  PairGrids grids;
  count_all(grids, model);
  for (std::size_t axis = 0; axis < grids.size(); ++axis) {
    std::uint32_t sum = 0;
    for (int bin = 0; bin < grids.bars(axis).bins(); ++bin) sum += grids.bars(axis).all(bin);
    const bool discrete = grids.axis(axis).kind == PlotAxis::Kind::discrete;
    EXPECT_EQ(sum, 600u) << (discrete ? "levels" : "values");
  }
}

}  // namespace
}  // namespace patina
