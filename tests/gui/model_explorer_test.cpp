#include "gui/explorer_model.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <limits>
#include <random>

#include "tests/gui/fake_source.h"

namespace patina {
namespace {

using testing::draw_at;
using testing::kCells;
using testing::kX;
using testing::kY;
using testing::small_table;

const PlotAxis kLp{PlotAxis::Kind::log_posterior, 0};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<Draw> random_draws(int count, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Draw> draws;
  for (int i = 0; i < count; ++i) {
    draws.push_back(draw_at(uniform(rng), uniform(rng), -10 * uniform(rng), i % 3 == 0, i % 4, i % 2));
    draws.back().iteration = i / 4;
  }
  return draws;
}

TEST(ExplorerModel, GivesBackEveryDrawAsItCame) {
  ExplorerModel model(small_table());
  const auto draws = random_draws(1000, 1);
  model.append(std::span(draws).first(10));
  model.append(std::span(draws).subspan(10));
  ASSERT_EQ(model.draws().size(), draws.size());
  for (std::size_t i = 0; i < draws.size(); ++i) {
    EXPECT_EQ(model.draws().values(i), draws[i].values);
    EXPECT_EQ(model.draws().lp(i), draws[i].lp);
    EXPECT_EQ(model.draws().chain(i), draws[i].chain);
    EXPECT_EQ(model.draws().iteration(i), draws[i].iteration);
    EXPECT_EQ(model.draws().warmup(i), draws[i].warmup);
  }
  EXPECT_EQ(model.draws().chain_count(), 4);
}

std::size_t heap_in_use() {
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

TEST(ExplorerModel, KeepsADrawInLittleMoreThanItsNumbersTakeHoweverManyThereAre) {
  constexpr int kParameters = 23;
  ParameterTable table;
  for (int i = 0; i < kParameters; ++i) table.continuous.push_back({"p" + std::to_string(i), "", "", {}});
  Draw draw = draw_at(0, 0, 0);
  draw.values = {std::vector<double>(kParameters, 0.5), {}};
  ExplorerModel model(table);
  const std::size_t before = heap_in_use();
  for (const std::size_t draws :
       {70'000u, 140'000u}) {  // a little above a power of two, where vectors have just grown
    while (model.draws().size() < draws) model.append({&draw, 1});
    const double per_draw = static_cast<double>(heap_in_use() - before) / static_cast<double>(draws);
    EXPECT_GE(per_draw, sizeof(double) * kParameters) << "the heap is not what it is kept in";
    EXPECT_LT(per_draw, 1.25 * sizeof(double) * kParameters);
  }
}

TEST(ExplorerModel, LeavesOutDrawsOfAnotherTable) {
  ExplorerModel model(small_table());
  Draw alien = draw_at(0.5, 0.5, 0);
  alien.values.continuous.push_back(1);
  model.append(std::vector{alien});
  EXPECT_EQ(model.draws().size(), 0u);
}

TEST(ExplorerModel, NearestIsWhatAnExhaustiveSearchInPixelsFinds) {
  ExplorerModel model(small_table());
  model.append(random_draws(500, 2));
  const double pixel_x = 1.0 / 700, pixel_y = 10.0 / 300;
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const double x = uniform(rng), y = -10 * uniform(rng);
    std::size_t expected = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model.draws().size(); ++i) {
      const double distance =
          std::hypot((model.draws().values(i).continuous[0] - x) * 700, (model.draws().lp(i) - y) * 30);
      if (distance < least) least = distance, expected = i;
    }
    EXPECT_EQ(model.nearest(kX, kLp, {x, y}, {pixel_x, pixel_y}, 1e6), expected);
    EXPECT_EQ(model.nearest(kX, kLp, {x, y}, {pixel_x, pixel_y}, 0.99 * least), std::nullopt);
    EXPECT_EQ(model.nearest(kX, kLp, {x, y}, {pixel_x, pixel_y}, 1.01 * least), expected);
  }
}

TEST(DrawColumns, ManyPlacesAtOnceAreThoseOfTheDrawsOneByOne) {
  ExplorerModel model(small_table());
  model.append(random_draws(10'000, 7));  // more than two chunks
  for (const PlotAxis& axis : {kX, kCells, kLp, PlotAxis{PlotAxis::Kind::iteration, 0}}) {
    for (const std::size_t first : {0u, 4095u, 4096u, 5000u, 9999u}) {
      std::vector<double> places(10'000 - first);
      model.draws().places(axis, first, places);
      for (std::size_t i = 0; i < places.size(); ++i)
        ASSERT_EQ(places[i], model.draws().place(axis, first + i)) << first << ", " << i;
    }
  }
}

TEST(ExplorerModel, AHiddenWarmupDrawCannotBeHitUnlessThereIsNothingElse) {
  ExplorerModel model(small_table());
  model.append(std::vector{draw_at(0.2, 0.2, -1, true)});
  model.hide_warmup(true);
  EXPECT_EQ(model.nearest(kX, kY, {0.2, 0.2}, {0.01, 0.01}, 5), 0u);
  model.append(std::vector{draw_at(0.8, 0.8, -2)});
  EXPECT_EQ(model.nearest(kX, kY, {0.2, 0.2}, {0.01, 0.01}, 5), std::nullopt);
  EXPECT_EQ(model.best(), 1u);
  model.hide_warmup(false);
  EXPECT_EQ(model.nearest(kX, kY, {0.2, 0.2}, {0.01, 0.01}, 5), 0u);
  EXPECT_EQ(model.best(), 0u);
}

TEST(ExplorerModel, FirstOfCoincidingDrawsIsSelectedAndNanIsNever) {
  ExplorerModel model(small_table());
  model.append(std::vector{draw_at(kNan, 0.5, -1), draw_at(0.5, 0.5, -3), draw_at(0.5, 0.5, -3)});
  EXPECT_EQ(model.nearest(kX, kY, {0.5, 0.5}, {0.01, 0.01}, 0), 1u);
}

TEST(ExplorerModel, RangesFollowTheDrawsAfterWarmupOnceThereAreAny) {
  ExplorerModel model(small_table());
  EXPECT_EQ(model.default_range(kX), (PlotRange{0, 1}));
  model.append(
      std::vector{draw_at(-40, 0, -900, true), draw_at(40, 0, -800, true), draw_at(kNan, 0, -kNan, true)});
  EXPECT_EQ(model.default_range(kX), (PlotRange{-40, 40}));
  EXPECT_EQ(model.default_range(kLp), (PlotRange{-900, -800}));
  model.append(std::vector{draw_at(0.3, 0, -1), draw_at(0.4, 0, -2)});
  EXPECT_EQ(model.default_range(kX), (PlotRange{0.3, 0.4}));
}

TEST(ExplorerModel, LevelsAreSpreadButNeverReachTheirNeighbours) {
  ExplorerModel model(small_table());
  model.append(random_draws(300, 4));
  double lowest = 1, highest = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    const double place = model.draws().place(kCells, i);
    EXPECT_EQ(std::lround(place), model.draws().values(i).discrete[0]);
    lowest = std::min(lowest, place), highest = std::max(highest, place);
  }
  EXPECT_LT(lowest, -0.25);
  EXPECT_GT(highest, 1.25);
}

TEST(ExplorerModel, WalkingByLpVisitsEveryDifferentDrawOnceFromBestToWorstAndBack) {
  ExplorerModel model(small_table());
  auto draws = random_draws(200, 5);
  for (int i = 0; i < 50; ++i) draws.push_back(draws[i]);  // repeats, as of rejected proposals
  model.append(draws);
  std::vector<double> expected;
  for (const Draw& draw : draws) expected.push_back(draw.lp);
  std::sort(expected.begin(), expected.end(), std::greater<>());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());

  std::vector<double> walked;
  while (model.select_worse()) walked.push_back(model.draws().lp(*model.selected()));
  EXPECT_EQ(walked, expected);
  std::vector<double> back{walked.back()};
  while (model.select_better()) back.push_back(model.draws().lp(*model.selected()));
  std::reverse(back.begin(), back.end());
  EXPECT_EQ(back, expected);
}

TEST(ExplorerModel, StartsAWalkAtTheBestDrawFromEitherSide) {
  ExplorerModel model(small_table());
  model.append(random_draws(20, 6));
  model.select_better();
  EXPECT_EQ(model.selected(), model.best());
  ExplorerModel empty(small_table());
  EXPECT_FALSE(empty.select_better());
  EXPECT_FALSE(empty.select_worse());
}

}  // namespace
}  // namespace patina
