#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "gui/plot/draw_colours.h"
#include "gui/window/theme.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

using testing::draw_at;
using testing::kCells;
using testing::kX;
using testing::small_table;

/// CIE lightness of a colour, 0 to 100 (IEC 61966-2-1 and CIE 15).
double lightness(ImU32 color) {
  const auto linear = [&](int shift) {
    const double v = static_cast<double>(color >> shift & 0xff) / 255;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 116 * std::cbrt(0.2126 * linear(0) + 0.7152 * linear(8) + 0.0722 * linear(16)) - 16;
}

TEST(RampColour, GrowsLighterInEvenStepsSoThatLightnessAloneTellsTheValue) {
  constexpr int kSteps = 16;
  const double whole = lightness(theme::ramp_color(1)) - lightness(theme::ramp_color(0));
  EXPECT_GT(whole, 50);
  for (int i = 0; i < kSteps; ++i) {
    const double step = lightness(theme::ramp_color((i + 1.0) / kSteps)) -
                        lightness(theme::ramp_color(static_cast<double>(i) / kSteps));
    EXPECT_NEAR(step, whole / kSteps, 0.5 * whole / kSteps) << i;
  }
}

TEST(RampColour, StaysAtItsEndsBeyondThem) {
  EXPECT_EQ(theme::ramp_color(-3), theme::ramp_color(0));
  EXPECT_EQ(theme::ramp_color(7), theme::ramp_color(1));
  EXPECT_EQ(theme::ramp_color(std::nan("")), theme::ramp_color(0));
}

ExplorerModel row_of_draws(int count) {
  ExplorerModel model(small_table());
  std::vector<Draw> draws;
  for (int i = 0; i < count; ++i) draws.push_back(draw_at(0.001 * i, 0, -i, false, i % 3, i % 2));
  model.append(draws);
  return model;
}

TEST(DrawColours, OfAScaleRunFromTheLowestToTheHighestDraw) {
  ExplorerModel model = row_of_draws(1000);
  model.colour_by({Colouring::Kind::axis, kX});
  DrawColours colours;
  colours.follow(model, 1);
  double last = 0;
  for (std::size_t draw = 0; draw < 1000; draw += 50) {
    const double light = lightness(colours.of(model, draw));
    EXPECT_GT(light, last);
    last = light;
  }
  EXPECT_LT(lightness(colours.of(model, 0)), lightness(theme::ramp_color(0.15)));
  EXPECT_GT(lightness(colours.of(model, 999)), lightness(theme::ramp_color(0.85)));
}

TEST(DrawColours, OfAScaleAreNotSquashedByAFewDrawsFarOff) {
  ExplorerModel model = row_of_draws(1000);
  model.append(std::vector{draw_at(1e9, 0, -1), draw_at(-1e9, 0, -1)});
  model.colour_by({Colouring::Kind::axis, kX});
  DrawColours colours;
  colours.follow(model, 1);
  EXPECT_NE(colours.of(model, 300), colours.of(model, 700));
}

TEST(DrawColours, TellChainsApartAndLevelsApart) {
  ExplorerModel model = row_of_draws(6);
  DrawColours colours;
  colours.follow(model, 1);
  EXPECT_EQ(colours.of(model, 0), colours.of(model, 3)) << "of one chain";
  EXPECT_EQ((std::set{colours.of(model, 0), colours.of(model, 1), colours.of(model, 2)}.size()), 3u);
  model.colour_by({Colouring::Kind::axis, kCells});
  colours.follow(model, 1);
  EXPECT_EQ(colours.of(model, 0), colours.of(model, 2)) << "of one level";
  EXPECT_NE(colours.of(model, 0), colours.of(model, 1));
}

TEST(DrawColours, HoldWhileDrawsArriveThatChangeTheRangeLittle) {
  ExplorerModel model = row_of_draws(1000);
  model.colour_by({Colouring::Kind::axis, kX});
  DrawColours colours;
  colours.follow(model, 1);
  const DrawColours before = colours;
  model.append(std::vector{draw_at(0.5, 0, -1), draw_at(1.0, 0, -1)});
  colours.follow(model, 1);
  EXPECT_EQ(colours, before) << "or a million points would be drawn anew";
  model.append(std::vector<Draw>(500, draw_at(3, 0, -1)));
  colours.follow(model, 1);
  EXPECT_NE(colours, before);
}

}  // namespace
}  // namespace patina
