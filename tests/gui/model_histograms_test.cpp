#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "gui/plot/parameter_histograms.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

using testing::draw_at;
using testing::small_table;

ParameterHistograms empty() { return ParameterHistograms(small_table(), {{0, 1}, {0, 2}}); }

constexpr std::size_t kAll = 1'000'000;

TEST(HistogramsTest, CountDrawsAfterWarmUpByBinAndLevel) {
  DrawColumns draws(small_table());
  draws.append(std::vector<Draw>{draw_at(0.5, 0.5, 0, true), draw_at(0, 0.5, 0),
                                 draw_at(1, 0.5, 0, false, 0, 1), draw_at(0.5 / 48, 2, 0),
                                 draw_at(7, -3, 0)});
  ParameterHistograms histograms = empty();
  EXPECT_TRUE(histograms.follow(draws, kAll));
  EXPECT_EQ(histograms.total(), 4u);
  EXPECT_EQ(histograms.continuous(0).front(), 2u);
  EXPECT_EQ(histograms.continuous(0).back(), 2u) << "the range's end, and what lies beyond";
  EXPECT_EQ(histograms.continuous(1)[12], 2u);
  EXPECT_EQ(histograms.continuous(1).back(), 1u);
  EXPECT_EQ(histograms.continuous(1).front(), 1u);
  EXPECT_EQ(histograms.discrete(0), (std::vector<std::uint32_t>{3, 1}));
}

TEST(HistogramsTest, InStepsTheyBecomeWhatTheyAreAtOnce) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> uniform;
  DrawColumns draws(small_table());
  ParameterHistograms in_steps = empty();
  bool caught_up = true;
  for (int batch = 0; batch < 30; ++batch) {
    std::vector<Draw> fresh;
    for (int i = 0; i < 100; ++i)
      fresh.push_back(draw_at(uniform(rng), 2 * uniform(rng), 0, i % 3 == 0, 0, static_cast<int>(rng() % 2)));
    draws.append(fresh);
    caught_up = in_steps.follow(draws, 70);
  }
  EXPECT_FALSE(caught_up);
  while (!in_steps.follow(draws, 70)) {
  }
  ParameterHistograms at_once = empty();
  at_once.follow(draws, kAll);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(in_steps.continuous(i), at_once.continuous(i));
    const auto& bins = at_once.continuous(i);
    EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), 0u), draws.sampling_count());
  }
  EXPECT_EQ(in_steps.discrete(0), at_once.discrete(0));
}

}  // namespace
}  // namespace patina
