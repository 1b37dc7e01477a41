#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "gui/plot/marking_outline.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

using testing::draw_at;
using testing::kX;
using testing::kY;
using testing::small_table;

std::set<std::size_t> random_set(std::mt19937& rng) {
  std::set<std::size_t> set;
  for (std::size_t i = rng() % 60; i > 0; --i) set.insert(rng() % 100);
  return set;
}

DrawSet as_draws(const std::set<std::size_t>& set) {
  return DrawSet::of(set.empty() ? 0 : *set.rbegin() + 1, [&](std::size_t i) { return set.contains(i); });
}

std::set<std::size_t> as_set(const DrawSet& draws) {
  std::set<std::size_t> set;
  for (std::size_t i = 0; i < 1000; ++i) {
    if (draws.contains(i)) set.insert(i);
  }
  return set;
}

TEST(DrawSet, JoinsAndDiffersAsSetsOfNumbersDo) {
  std::mt19937 rng(1);
  for (int trial = 0; trial < 200; ++trial) {
    const auto a = random_set(rng), b = random_set(rng);
    std::set<std::size_t> both = a, rest;
    both.insert(b.begin(), b.end());
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(rest, rest.end()));
    EXPECT_EQ(as_set(as_draws(a).with(as_draws(b))), both);
    EXPECT_EQ(as_set(as_draws(a).without(as_draws(b))), rest);
    EXPECT_EQ(as_draws(a).with(as_draws(b)).size(), both.size());
    EXPECT_EQ(as_draws(a) == as_draws(b), a == b);
    EXPECT_EQ(as_draws(a), as_draws(both).without(as_draws(b).without(as_draws(a))));
  }
}

/// Draws spread evenly over the unit square.
ExplorerModel evenly_spread(int count) {
  ExplorerModel model(small_table());
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Draw> draws;
  for (int i = 0; i < count; ++i) draws.push_back(draw_at(uniform(rng), uniform(rng), -1, i % 10 == 0));
  model.append(draws);
  return model;
}

TEST(Marking, ABoxHoldsExactlyTheDrawsBetweenItsSidesWhicheverCornerItBeginsAt) {
  const ExplorerModel model = evenly_spread(2000);
  for (const auto& [from, to] : {std::pair<PlotPlace, PlotPlace>{{0.2, 0.3}, {0.7, 0.5}},
                                 {{0.7, 0.5}, {0.2, 0.3}},
                                 {{0.2, 0.5}, {0.7, 0.3}}}) {
    MarkingOutline box;
    box.begin(MarkingTool::box, from);
    box.extend({0.99, 0.99});
    box.extend(to);
    const DrawSet inside = model.inside(kX, kY, box.outline());
    for (std::size_t draw = 0; draw < model.draws().size(); ++draw) {
      const double x = model.draws().place(kX, draw), y = model.draws().place(kY, draw);
      ASSERT_EQ(inside.contains(draw), x > 0.2 && x < 0.7 && y > 0.3 && y < 0.5) << x << ", " << y;
    }
  }
}

TEST(Marking, ALassoAroundADiscHoldsExactlyTheDisc) {
  const ExplorerModel model = evenly_spread(2000);
  MarkingOutline lasso;
  constexpr int kCorners = 720;
  for (int i = 0; i < kCorners; ++i) {
    const double turn = 2 * M_PI * i / kCorners;
    const PlotPlace at{0.5 + 0.3 * std::cos(turn), 0.5 + 0.3 * std::sin(turn)};
    lasso.active() ? lasso.extend(at) : lasso.begin(MarkingTool::lasso, at);
  }
  const DrawSet inside = model.inside(kX, kY, lasso.outline());
  for (std::size_t draw = 0; draw < model.draws().size(); ++draw) {
    const double distance =
        std::hypot(model.draws().place(kX, draw) - 0.5, model.draws().place(kY, draw) - 0.5);
    if (std::abs(distance - 0.3) > 1e-4) {
      ASSERT_EQ(inside.contains(draw), distance < 0.3);
    }
  }
}

TEST(Marking, ALassoMayHaveABay) {
  // A U: the square without its upper middle.
  const std::vector<PlotPlace> bay{{0, 0},     {1, 0},     {1, 1},   {0.7, 1},
                                   {0.7, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}};
  const ExplorerModel model = evenly_spread(2000);
  const DrawSet inside = model.inside(kX, kY, bay);
  for (std::size_t draw = 0; draw < model.draws().size(); ++draw) {
    const double x = model.draws().place(kX, draw), y = model.draws().place(kY, draw);
    ASSERT_EQ(inside.contains(draw), !(x > 0.3 && x < 0.7 && y > 0.3)) << x << ", " << y;
  }
}

TEST(Marking, HiddenWarmupDrawsAreNotMarked) {
  ExplorerModel model = evenly_spread(500);
  const std::vector<PlotPlace> all{{-1, -1}, {2, -1}, {2, 2}, {-1, 2}};
  EXPECT_EQ(model.inside(kX, kY, all).size(), 500u);
  model.hide_warmup(true);
  EXPECT_EQ(model.inside(kX, kY, all).size(), 450u);
}

TEST(Marking, AnOutlineWithoutAnInsideHoldsNothing) {
  const ExplorerModel model = evenly_spread(500);
  EXPECT_TRUE(model.inside(kX, kY, {}).empty());
  EXPECT_TRUE(model.inside(kX, kY, std::vector<PlotPlace>{{0, 0}, {1, 1}}).empty());
  EXPECT_TRUE(model.inside(kX, kY, std::vector<PlotPlace>{{0, 0}, {1, 0}, {0.5, 0}}).empty());
}

TEST(Marking, MarksReplaceAddAndRemove) {
  ExplorerModel model = evenly_spread(10);
  const auto one = [&](std::size_t which) {
    return DrawSet::of(10, [=](std::size_t draw) { return draw == which; });
  };
  model.mark(one(1), Marking::replace);
  model.mark(one(2), Marking::replace);
  model.mark(one(3), Marking::add);
  EXPECT_EQ(as_set(model.marked()), (std::set<std::size_t>{2, 3}));
  model.mark(one(2), Marking::remove);
  EXPECT_EQ(as_set(model.marked()), (std::set<std::size_t>{3}));
}

TEST(Marking, TheRangeOfASetIsThatOfItsDrawsAlone) {
  ExplorerModel model(small_table());
  model.append(
      std::vector{draw_at(0.1, 0, -1), draw_at(0.4, 0, -1), draw_at(0.6, 0, -1), draw_at(0.9, 0, -1)});
  const auto middle = DrawSet::of(4, [](std::size_t draw) { return draw == 1 || draw == 2; });
  EXPECT_EQ(range_of(model.draws(), middle, kX), (PlotRange{0.4, 0.6}));
  EXPECT_EQ(range_of(model.draws(), {}, kX), (PlotRange{0, 0}));
}

}  // namespace
}  // namespace patina
