#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gui/plot/plot_axis.h"
#include "gui/words.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

TEST(RoundTicks, LieInTheRangeAreEvenlySpacedAndFillIt) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> exponent(-6, 6), centre(-3, 3);
  for (int trial = 0; trial < 500; ++trial) {
    const double span = std::pow(10, exponent(rng));
    const PlotRange range{centre(rng) * span, 0};
    const PlotRange whole{range.low, range.low + span};
    const auto ticks = round_ticks(whole, 6);
    ASSERT_GE(ticks.size(), 2u) << whole.low << " " << whole.high;
    ASSERT_LE(ticks.size(), 6u);
    const double step = ticks[1] - ticks[0];
    for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_NEAR(ticks[i] - ticks[i - 1], step, 1e-9 * span);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_GE(ticks[i], whole.low - 1e-9 * span);
      EXPECT_LE(ticks[i], whole.high + 1e-9 * span);
    }
    const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 ||
                std::abs(mantissa - 5) < 1e-6)
        << step;
  }
}

TEST(RoundTicks, AreNoneForARangeWithoutExtent) {
  EXPECT_TRUE(round_ticks({1, 1}, 5).empty());
  EXPECT_TRUE(round_ticks({0, std::nan("")}, 5).empty());
}

TEST(FollowedView, StaysWhileTheDataFillItAndMovesWhenTheyLeaveOrShrink) {
  const PlotRange view{0, 10};
  EXPECT_EQ(followed(view, {1, 9}), view);
  const PlotRange grown = followed(view, {1, 12});
  EXPECT_LT(grown.low, 1);
  EXPECT_GT(grown.high, 12);
  EXPECT_LT(followed(view, {4, 5}).span(), 2);
  EXPECT_GT(followed(view, {5, 5}).span(), 0);
}

TEST(Words, NumbersKeepTheirSignificantDigits) {
  EXPECT_EQ(number_text(1497.3, 4), "1497");
  EXPECT_EQ(number_text(0.012345, 3), "0.0123");
  EXPECT_EQ(number_text(0.5, 3), "0.5");
  EXPECT_EQ(number_text(-0.0, 3), "0");
  EXPECT_EQ(number_text(2, 3), "2");
  EXPECT_EQ(number_text(1e-7, 3), "1.00e-07");
  EXPECT_EQ(number_text(std::nan("")), "\u2013");
  for (const double value : {3.14159, 271.828, 0.00161803, -57721.5}) {
    EXPECT_NEAR(std::stod(number_text(value, 4)), value, 5e-4 * std::abs(value));
  }
}

TEST(Words, AMeanIsWrittenAsFinelyAsItsSpread) {
  EXPECT_EQ(mean_sd_text(1503.7, 41.2), "1504 \u00b1 41");
  EXPECT_EQ(mean_sd_text(0.4, 0.03), "0.400 \u00b1 0.030");
  EXPECT_EQ(mean_sd_text(15, 0), "15");
  EXPECT_EQ(mean_sd_text(0.5, std::nan("")), "0.5");
}

TEST(Words, ParametersAreNamedForTheEye) {
  EXPECT_EQ(parameter_label("albedo_r"), "Base colour red");
  EXPECT_EQ(parameter_label("rough"), "Roughness");
  EXPECT_EQ(parameter_label("ring_size"), "Ring size");
  EXPECT_EQ(parameter_label("_r"), " r");
  EXPECT_EQ(count_text(1234567), "1 234 567");
  EXPECT_EQ(count_text(-123), "-123");
}

TEST(PlotAxes, NameEveryParameterThenLpAndLevelsByName) {
  const ParameterTable table = testing::small_table();
  const auto axes = plot_axes(table);
  ASSERT_EQ(axes.size(), 4u);
  EXPECT_EQ(axis_label(table, axes[1]), "Bump frequency (cycles/cm)");
  EXPECT_EQ(axis_label(table, axes[2]), "Cell pattern");
  EXPECT_EQ(tick_label(table, axes[2], 1), "coarse");
  EXPECT_EQ(tick_label(table, axes[2], 0.5), "");
  EXPECT_EQ(tick_label(table, axes[2], 2), "");
}

}  // namespace
}  // namespace patina
