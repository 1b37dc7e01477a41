#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/chart/draw_chart.h"
#include "engine/chart/labels.h"
#include "engine/chart/log_axis.h"
#include "engine/sampling/rng.h"

namespace patina {
namespace {

/// Why a document is no well-formed XML of elements, attributes and text; empty if it is.
std::string xml_problem(const std::string& xml) {
  std::vector<std::string> open;
  std::size_t at = xml.find("?>") + 2, roots = 0;
  while (at < xml.size()) {
    const std::size_t tag = xml.find('<', at), end = xml.find('>', tag);
    const std::string text = xml.substr(at, tag - at);
    for (std::size_t i = text.find('&'); i != std::string::npos; i = text.find('&', i + 1))
      if (text.find(';', i) == std::string::npos) return "a bare & in " + text;
    if (tag == std::string::npos) break;
    if (end == std::string::npos) return "a tag without end";
    const std::string inside = xml.substr(tag + 1, end - tag - 1);
    if (inside.find('<') != std::string::npos) return "a bare < in " + inside;
    if (std::ranges::count(inside, '"') % 2 != 0) return "an open quote in " + inside;
    const std::string name = inside.substr(0, inside.find_first_of(" /", 1));
    if (name.starts_with('/')) {
      if (open.empty() || "/" + open.back() != name) return name + " closes nothing";
      open.pop_back();
    } else if (!inside.ends_with('/')) {
      roots += open.empty();
      open.push_back(name);
    }
    at = end + 1;
  }
  if (!open.empty()) return open.back() + " is left open";
  return roots == 1 ? "" : "not one root";
}

ChartPoint some_point(const std::string& name, double cost, double error) {
  ChartPoint point;
  point.name = name;
  point.is_default = name == kDefaultSetting;
  point.seconds_per_draw = point.evaluations_per_draw = {cost, cost / 1.1, cost * 1.1};
  point.mean = point.sd = point.wasserstein = {{error, error / 1.2, error * 1.2}, error / 3, error > 0.1};
  return point;
}

std::vector<ChartPoint> crowded_points() {
  std::vector<ChartPoint> points{some_point(kDefaultSetting, 0.1, 0.05), some_point("a < b & c", 0.4, 0.3)};
  for (int i = 0; i < 10; ++i)
    points.push_back(
        some_point("setting " + std::to_string(i), 0.1 * (1 + 0.1 * i), 0.05 * (1 + 0.05 * (i % 4))));
  points.push_back(some_point("nothing drawn", NAN, NAN));
  return points;
}

const ChartTitle kTitle{"bump & co", "Gold standard", "budget"};

TEST(Drawing, of_a_chart_is_well_formed_and_names_every_setting_in_every_panel) {
  const std::string svg = to_svg(draw_chart(crowded_points(), kTitle));
  EXPECT_EQ(xml_problem(svg), "");
  const auto count = [&](const std::string& text) {
    int found = 0;
    for (std::size_t i = svg.find(text); i != std::string::npos; i = svg.find(text, i + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(">a &lt; b &amp; c</text>"), 4);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(count(">setting " + std::to_string(i) + "</text>"), 4);
  EXPECT_EQ(count("Without draws in its time: nothing drawn."), 1);
  EXPECT_NE(xml_problem(svg.substr(0, svg.size() - 8)), "") << "the check finds what is cut off";
  EXPECT_EQ(xml_problem(to_svg(draw_chart({}, kTitle))), "") << "also of nothing";
}

TEST(Drawing, of_waiting_is_well_formed_and_names_every_setting) {
  const std::vector<WaitingCurve> curves{{"default", 1, {{1, 0.5, 0}, {2, 0.4, 10}}},
                                         {"x<y", 1, {{1, 0.7, 0}}}};
  const std::string svg = to_svg(draw_waiting(curves, 0.01, kTitle));
  EXPECT_EQ(xml_problem(svg), "");
  EXPECT_NE(svg.find(">x&lt;y</text>"), std::string::npos);
  EXPECT_EQ(xml_problem(to_svg(draw_waiting({}, 0.01, kTitle))), "");
}

double ink(const Image& image) {
  double sum = 0;
  for (const float value : image.pixels) sum += (1.0 - value) / 3;
  return sum;
}

TEST(Drawing, shapes_as_pixels_cover_their_areas) {
  Scene disc{60, 50, "", {SceneDisc{{30.3, 24.6}, 15, {0, 0, 0}, {}, 0}}};
  EXPECT_NEAR(ink(to_image(disc)), std::numbers::pi * 15 * 15, 5);
  Scene line{100, 90, "", {SceneLine{{10, 10}, {80, 70}, {0, 0, 0}, 3}}};
  EXPECT_NEAR(ink(to_image(line)), 3 * std::hypot(70, 60) + std::numbers::pi * 1.5 * 1.5, 8);
  Scene half = disc;
  std::get<SceneDisc>(half.shapes[0]).fill.opacity = 0.5;
  EXPECT_NEAR(ink(to_image(half)), ink(to_image(disc)) / 2, 1e-3);
}

TEST(Drawing, text_as_pixels_is_about_as_wide_as_names_are_given_room_for) {
  const std::string text = "warm-up 500 refresh 0.25";
  const Image image = to_image({400, 40, "", {SceneText{{5, 25}, text, Anchor::start, 14, {}, false}}});
  int last = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      if (image.at(row, column, 0) < 0.7f) last = std::max(last, column);
  EXPECT_NEAR(last - 5, text_width(text, 14), 0.2 * text_width(text, 14));
}

TEST(LabelPlacer, keeps_the_names_of_near_points_apart_and_inside) {
  const Box area{0, 0, 500, 240};
  std::vector<ScenePoint> points;
  Rng rng(1);
  for (int i = 0; i < 12; ++i) points.push_back({200 + 100 * rng.uniform(), 90 + 60 * rng.uniform()});
  LabelPlacer placer(area, {});
  std::vector<Box> placed;
  for (const ScenePoint& point : points) {
    const Box box = placer.place(point, 80, 13);
    EXPECT_NEAR(overlap(box, area), 80 * 13, 1e-9);
    for (const Box& other : placed) EXPECT_EQ(overlap(box, other), 0);
    placed.push_back(box);
  }
}

TEST(LogAxis, runs_evenly_in_logarithms_and_stops_at_its_ends) {
  const LogAxis axis{0.01, 100, 50, 450};
  EXPECT_NEAR(axis.pixel(1), 250, 1e-9);
  EXPECT_NEAR(axis.pixel(10) - axis.pixel(1), axis.pixel(1) - axis.pixel(0.1), 1e-9);
  EXPECT_EQ(axis.pixel(1e-9), 50);
  EXPECT_EQ(axis.pixel(1e9), 450);
}

TEST(LogAxis, holds_all_its_values_and_has_a_few_labels_whatever_they_are) {
  Rng rng(2);
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::vector<double> values{NAN, 0, -1};
    const double middle = std::pow(10, 8 * rng.uniform() - 4), spread = 4 * rng.uniform();
    for (int i = 0; i < 5; ++i) values.push_back(middle * std::pow(10, spread * (rng.uniform() - 0.5)));
    const LogAxis axis = fitted_axis(values, 1.2, 1.2);
    for (std::size_t i = 3; i < values.size(); ++i)
      EXPECT_TRUE(axis.low < values[i] && values[i] < axis.high);
    int labels = 0;
    for (const Tick& tick : log_ticks(axis.low, axis.high)) {
      EXPECT_TRUE(axis.low <= tick.value && tick.value <= axis.high);
      if (tick.label.empty()) continue;
      EXPECT_NEAR(std::stod(tick.label) / tick.value, 1, 1e-5);
      ++labels;
    }
    EXPECT_TRUE(2 <= labels && labels <= 9) << axis.low << " " << axis.high;
  }
}

}  // namespace
}  // namespace patina
