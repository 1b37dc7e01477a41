// Histograms, levels of a density and its contours, against what is known of the Gaussian.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "gui/plot/contour_lines.h"
#include "gui/plot/credible_regions.h"
#include "gui/plot/density_levels.h"
#include "gui/plot/histogram.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

constexpr std::array<double, 2> kShares{0.5, 0.9};

/// A circular Gaussian in the middle of a grid, sd so many cells.
Image gaussian(int cells, double sd) {
  Image density(cells, cells, 1);
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const double dx = column + 0.5 - 0.5 * cells, dy = row + 0.5 - 0.5 * cells;
      density.at(row, column, 0) = static_cast<float>(std::exp(-0.5 * (dx * dx + dy * dy) / (sd * sd)));
    }
  }
  return density;
}

double radius_of(double share) { return std::sqrt(-2 * std::log(1 - share)); }

bool inside(const std::vector<ContourPiece>& edge, double x, double y) {
  bool odd = false;
  for (const ContourPiece& p : edge) {
    if ((p.y0 > y) != (p.y1 > y) && x < p.x0 + (y - p.y0) / (p.y1 - p.y0) * (p.x1 - p.x0)) odd = !odd;
  }
  return odd;
}

TEST(HighestDensityLevels, OfAGaussianAreOneLessTheShareOfItsPeak) {
  const auto levels = highest_density_levels(gaussian(120, 14), kShares);
  EXPECT_NEAR(levels[0], 0.5, 0.005);
  EXPECT_NEAR(levels[1], 0.1, 0.002);
}

TEST(HighestDensityLevels, OfTwoPeaksAreSharedByBoth) {
  Image density(4, 1, 1);
  density.pixels = {4, 1, 4, 1};
  EXPECT_EQ(highest_density_levels(density, std::array{0.5})[0], 4);
  EXPECT_EQ(highest_density_levels(density, std::array{0.85})[0], 1);
}

TEST(ContourLines, OfAGaussianAreCirclesOfTheKnownRadius) {
  const double sd = 14;
  const Image density = gaussian(120, sd);
  for (const double share : kShares) {
    const auto edge = contour_lines(density, 1 - share);
    ASSERT_GT(edge.size(), 50u);
    double length = 0;
    for (const ContourPiece& p : edge) {
      EXPECT_NEAR(std::hypot(p.x0 - 60, p.y0 - 60), sd * radius_of(share), 0.05);
      length += std::hypot(p.x1 - p.x0, p.y1 - p.y0);
    }
    EXPECT_NEAR(length, 2 * M_PI * sd * radius_of(share), 0.2) << "the circle is closed, and there is one";
  }
}

TEST(ContourLines, CloseAlongTheBorderAndGoRoundBothSummitsOfASaddle) {
  Image density(2, 2, 1);
  density.pixels = {1, 0, 0, 1};
  const auto edge = contour_lines(density, 0.5);
  EXPECT_TRUE(inside(edge, 0.5, 0.5));
  EXPECT_TRUE(inside(edge, 1.5, 1.5));
  EXPECT_FALSE(inside(edge, 1, 1));
  EXPECT_FALSE(inside(edge, 1.5, 0.5));
  EXPECT_EQ(edge.size(), 8u) << "two diamonds";
}

TEST(SmoothedCounts, KeepTheSumAndAddTheVariances) {
  Image counts(80, 60, 1);
  counts.at(30, 40, 0) = 1000;
  const Image density = smoothed_counts(counts, 5, 2);
  double sum = 0, across = 0, down = 0;
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 80; ++column) {
      const double value = density.at(row, column, 0);
      sum += value;
      across += value * (column - 40) * (column - 40);
      down += value * (row - 30) * (row - 30);
    }
  }
  EXPECT_NEAR(sum, 1000, 0.5);
  EXPECT_NEAR(across / sum, 25, 0.4);
  EXPECT_NEAR(down / sum, 4, 0.1);
}

/// Draws of a Gaussian with the given sds and correlation.
ExplorerModel gaussian_draws(int count, double sd_x, double sd_y, double correlation) {
  ExplorerModel model(testing::small_table());
  std::mt19937 rng(5);
  std::normal_distribution<double> normal;
  std::vector<Draw> draws;
  for (int i = 0; i < count; ++i) {
    const double a = normal(rng),
                 b = correlation * a + std::sqrt(1 - correlation * correlation) * normal(rng);
    draws.push_back(testing::draw_at(3 + sd_x * a, -7 + sd_y * b, -1));
  }
  model.append(draws);
  return model;
}

using testing::kX;
using testing::kY;

TEST(CredibleRegions, OfACorrelatedGaussianHoldTheirSharesAndHaveItsShape) {
  const double correlation = 0.8;
  const ExplorerModel model = gaussian_draws(50'000, 0.01, 40, correlation);
  const auto edges = credible_regions(model, kX, kY);
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    std::size_t held = 0;
    for (std::size_t draw = 0; draw < model.draws().size(); ++draw)
      held += inside(edges[i], model.draws().place(kX, draw), model.draws().place(kY, draw));
    EXPECT_NEAR(static_cast<double>(held) / 50'000, kShares[i], 0.02);
    double largest = 0, mean = 0;
    for (const ContourPiece& p : edges[i]) {
      const double a = (p.x0 - 3) / 0.01, b = (p.y0 + 7) / 40;
      const double radius =
          std::sqrt((a * a + b * b - 2 * correlation * a * b) / (1 - correlation * correlation));
      largest = std::max(largest, radius), mean += radius / static_cast<double>(edges[i].size());
    }
    EXPECT_NEAR(mean, radius_of(kShares[i]), 0.06);
    EXPECT_LT(largest, 1.2 * radius_of(kShares[i])) << "no islands far out";
  }
}

TEST(CredibleRegions, LeaveWarmupOutAndNeedDrawsThatDiffer) {
  ExplorerModel model = gaussian_draws(2000, 1, 1, 0);
  const auto before = credible_regions(model, kX, kY);
  model.append(std::vector<Draw>(500, testing::draw_at(1000, 1000, -9, true)));
  const auto after = credible_regions(model, kX, kY);
  ASSERT_EQ(after[1].size(), before[1].size());
  for (std::size_t i = 0; i < after[1].size(); ++i) EXPECT_EQ(after[1][i].x0, before[1][i].x0);

  ExplorerModel still(testing::small_table());
  still.append(std::vector<Draw>(100, testing::draw_at(0.5, 0.5, -1)));
  EXPECT_TRUE(credible_regions(still, kX, kY)[0].empty());
}

TEST(CredibleRegions, AreSmoothedMoreWhereTheDrawsAreWorthFewer) {
  const ExplorerModel model = gaussian_draws(5000, 1, 1, 0);
  const auto mean_radius = [&](std::optional<double> worth) {
    const auto edge = credible_regions(model, kX, kY, worth)[0];
    double sum = 0;
    for (const ContourPiece& p : edge) sum += std::hypot(p.x0 - 3, p.y0 + 7);
    return sum / static_cast<double>(edge.size());
  };
  // A Gaussian of variance 1 smoothed by one of n^(-1/3) has variance 1 + n^(-1/3).
  const double wide = mean_radius(100) / mean_radius({});
  EXPECT_NEAR(wide, std::sqrt((1 + std::cbrt(1.0 / 100)) / (1 + std::cbrt(1.0 / 5000))), 0.02);
  EXPECT_EQ(mean_radius(1e9), mean_radius({})) << "never more than there are";
}

TEST(CredibleRegions, AreMadeAnewOnlyForOtherAxesOrManyMoreDraws) {
  ExplorerModel model = gaussian_draws(1000, 1, 1, 0.5);
  CredibleRegions regions;
  const double before = regions.follow(model, 1, kX, kY)[0].at(0).x0;
  const std::vector<Draw> far(30, testing::draw_at(50, 50, -1));
  model.append(std::span(far).first(15));
  EXPECT_EQ(regions.follow(model, 1, kX, kY)[0].at(0).x0, before);
  model.append(std::span(far).last(15));
  EXPECT_NE(regions.follow(model, 1, kX, kY)[0].at(0).x0, before);
}

TEST(Histogram, CountsEveryValueOfItsRangeOnceInTheBinThatHoldsIt) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> uniform(-1, 3);
  const PlotRange range{0.25, 1.75};
  Histogram histogram(range, 13);
  std::array<std::uint32_t, 13> all{}, marked{};
  for (int i = 0; i < 5000; ++i) {
    const double value = uniform(rng);
    histogram.add(value, i % 3 == 0);
    const double bin = std::floor((value - 0.25) / 1.5 * 13);
    if (bin < 0 || bin > 12) continue;
    ++all[static_cast<std::size_t>(bin)];
    if (i % 3 == 0) ++marked[static_cast<std::size_t>(bin)];
  }
  for (int bin = 0; bin < 13; ++bin) {
    EXPECT_EQ(histogram.all(bin), all[static_cast<std::size_t>(bin)]);
    EXPECT_EQ(histogram.marked(bin), marked[static_cast<std::size_t>(bin)]);
  }
  EXPECT_EQ(histogram.peak(), *std::ranges::max_element(all));
  histogram.add(std::nan(""), true);
  histogram.add(1.75, true);
  EXPECT_EQ(histogram.peak(), *std::ranges::max_element(all));
}

}  // namespace
}  // namespace patina
