// The scatter plot's cloud: the right pixels, and the same ones whether drawn at once or as they arrive.

#include <random>
#include <vector>

#include "gl_fixture.h"
#include "gui/gl/point_renderer.h"

namespace patina {
namespace {

constexpr std::uint32_t kRed = 0xff0000ffu;
constexpr std::uint32_t kGreen = 0xff00ff00u;

std::vector<PlotPoint> cloud(std::size_t count) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<PlotPoint> points(count);
  for (PlotPoint& point : points) {
    point.x = normal(random);
    point.y = normal(random);
    point.color = 0x60000000u | (random() & 0x00ffffffu);
    point.dimmed = random() % 4 == 0;
  }
  return points;
}

constexpr PlotWindow kWindow{-2, 2, -1.5, 1.5};

Image drawn_at_once(const Gl& gl, const std::vector<PlotPoint>& points, const PointStyle& style = {}) {
  PointRenderer renderer(gl, style);
  renderer.set_view(kWindow, 160, 120);
  renderer.append(points);
  renderer.render();
  return renderer.read();
}

double opacity(const Image& image) {
  double sum = 0;
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) sum += image.pixels[i];
  return sum;
}

TEST_F(GlTest, APointLightsTheDiscAroundItsPlace) {
  PointRenderer renderer(gl(), {.diameter = 6});
  renderer.set_view({0, 10, 100, 200}, 40, 30);
  // A quarter from the left, a third from the top: the corner between pixels 9, 10 and 9, 10.
  renderer.append(std::vector<PlotPoint>{{2.5, 200 - 100.0 / 3, kRed, false}});
  EXPECT_TRUE(renderer.render());
  const Image image = renderer.read();
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 40; ++column) {
      const double distance = std::hypot(column + 0.5 - 10, row + 0.5 - 10);
      const float alpha = image.at(row, column, 3);
      if (distance <= 2.4 || distance >= 3.6) {
        ASSERT_EQ(alpha, distance < 3) << row << ", " << column;
      }
      ASSERT_EQ(image.at(row, column, 0), alpha) << "red, multiplied by its opacity";
      ASSERT_EQ(image.at(row, column, 1), 0);
    }
  }
  EXPECT_NEAR(opacity(image), 9 * M_PI, 1.5) << "the area of the disc";
}

TEST_F(GlTest, PointsOutsideTheViewLeaveNoTrace) {
  const std::vector<PlotPoint> outside{
      {9, 0, kRed, false}, {-9, 0, kRed, false}, {0, 9, kRed, false}, {0, -9, kRed, false}};
  EXPECT_EQ(opacity(drawn_at_once(gl(), outside)), 0);
}

TEST_F(GlTest, LaterPointsLieOnTop) {
  const Image image = drawn_at_once(gl(), {{0, 0, kRed, false}, {0, 0, kGreen, false}});
  EXPECT_EQ(pixel(image, 60, 80), (Rgb{0, 255, 0}));
}

TEST_F(GlTest, DimmedPointsAreFainter) {
  const double plain = opacity(drawn_at_once(gl(), {{0, 0, kRed, false}}));
  const double faint = opacity(drawn_at_once(gl(), {{0, 0, kRed, true}}));
  EXPECT_GT(faint, 0);
  EXPECT_LT(faint, 0.5 * plain);
}

TEST_F(GlTest, AppendedPointsGiveTheSamePixelsAsOneRedraw) {
  const auto points = cloud(5000);
  PointRenderer renderer(gl());
  renderer.set_view(kWindow, 160, 120);
  for (std::size_t begin = 0, step = 1; begin < points.size(); begin += step, step = 2 * step + 1) {
    step = std::min(step, points.size() - begin);
    renderer.append(std::span(points).subspan(begin, step));
    EXPECT_TRUE(renderer.render());
  }
  EXPECT_EQ(renderer.size(), points.size());
  EXPECT_EQ(renderer.read().pixels, drawn_at_once(gl(), points).pixels);
}

TEST_F(GlTest, NothingIsRedrawnWhileNothingChanges) {
  PointRenderer renderer(gl());
  renderer.set_view(kWindow, 160, 120);
  renderer.append(cloud(10));
  EXPECT_TRUE(renderer.render());
  renderer.set_view(kWindow, 160, 120);
  EXPECT_FALSE(renderer.render());
  renderer.set_view({-1, 1, -1, 1}, 160, 120);
  EXPECT_TRUE(renderer.render());
}

TEST_F(GlTest, ReturningToAViewReturnsToItsPixels) {
  const auto points = cloud(2000);
  PointRenderer renderer(gl());
  renderer.set_view({0, 1, 0, 1}, 90, 70);
  renderer.append(points);
  renderer.render();
  renderer.set_view(kWindow, 160, 120);
  renderer.render();
  EXPECT_EQ(renderer.read().pixels, drawn_at_once(gl(), points).pixels);
}

TEST_F(GlTest, ClearedPointsAreGone) {
  PointRenderer renderer(gl());
  renderer.set_view(kWindow, 160, 120);
  renderer.append(cloud(100));
  renderer.render();
  renderer.clear();
  EXPECT_TRUE(renderer.render());
  EXPECT_EQ(opacity(renderer.read()), 0);
}

TEST_F(GlTest, AFarZoomStillPlacesPointsToThePixel) {
  // 1e-9 wide about 1000: floats would put both points on one pixel.
  PointRenderer renderer(gl(), {.diameter = 2});
  renderer.set_view({1000, 1000 + 1e-9, 0, 1}, 100, 10);
  renderer.append(
      std::vector<PlotPoint>{{1000 + 2e-10, 0.5, kRed, false}, {1000 + 8e-10, 0.5, kGreen, false}});
  renderer.render();
  const Image image = renderer.read();
  EXPECT_GT(image.at(5, 20, 0), 0.5f);
  EXPECT_GT(image.at(5, 80, 1), 0.5f);
  EXPECT_EQ(image.at(5, 50, 3), 0);
}

std::uint64_t inside(const std::vector<PlotPoint>& points, const PlotWindow& w) {
  std::uint64_t count = 0;
  for (const PlotPoint& p : points)
    count += p.x >= w.x_low && p.x < w.x_high && p.y >= w.y_low && p.y < w.y_high;
  return count;
}

TEST_F(GlTest, TheDensityMapCountsEveryPointInViewOnce) {
  const auto points = cloud(3000);
  PointRenderer renderer(gl(), {.density_above = 500});
  renderer.append(points);
  for (const PlotWindow& window : {kWindow, PlotWindow{0, 0.5, -3, 3}, PlotWindow{50, 51, 0, 1}}) {
    renderer.set_view(window, 161, 119);
    renderer.render();
    ASSERT_TRUE(renderer.shows_density());
    EXPECT_EQ(renderer.density_total(), inside(points, window));
  }
}

TEST_F(GlTest, TheDensityMapIsTheSameHoweverThePointsArrive) {
  const auto points = cloud(3000);
  const PointStyle style{.density_above = 500};
  PointRenderer renderer(gl(), style);
  renderer.set_view(kWindow, 160, 120);
  for (const auto& [begin, count] : {std::pair{0, 400}, {400, 200}, {600, 2400}}) {
    renderer.append(std::span(points).subspan(begin, count));
    renderer.render();
  }
  EXPECT_EQ(renderer.read().pixels, drawn_at_once(gl(), points, style).pixels);
  renderer.clear();
  EXPECT_FALSE(renderer.shows_density()) << "few points are points again";
}

TEST_F(GlTest, DenserPlacesOfTheDensityMapAreLighter) {
  std::vector<PlotPoint> points;
  const auto pile = [&](double x, int count) { points.insert(points.end(), count, {x, 0, kRed, false}); };
  pile(-1, 2000);
  pile(0, 50);
  pile(1, 1);
  const Image image = drawn_at_once(gl(), points, {.density_above = 1});
  const auto brightness = [&](int column) {
    const Rgb c = pixel(image, 60, column);
    return c.red + c.green + c.blue;
  };
  EXPECT_GT(brightness(40), brightness(80));
  EXPECT_GT(brightness(80), brightness(120));
  EXPECT_GT(brightness(120), 0);
  EXPECT_EQ(brightness(100), 0) << "between the piles";
}

TEST_F(GlTest, ADensityMapOfMeanColoursShowsThePointsOwnAndMixesThemByTheirNumbers) {
  std::vector<PlotPoint> points(100, {-1, 0, kRed, false});
  points.insert(points.end(), 100, {1, 0, kGreen, false});
  points.insert(points.end(), 75, {0, 0, kRed, false});
  points.insert(points.end(), 25, {0, 0, kGreen, false});
  const Image image =
      drawn_at_once(gl(), points, {.density_above = 1, .density_colours = DensityColours::mean});
  const Rgb left = pixel(image, 60, 40), middle = pixel(image, 60, 80), right = pixel(image, 60, 120);
  EXPECT_GT(left.red, 150);
  EXPECT_EQ(left.green, 0);
  EXPECT_GT(right.green, 150);
  EXPECT_EQ(right.red, 0);
  EXPECT_NEAR(middle.red / 3.0, middle.green, 2) << "three red points to a green one";
}

TEST_F(GlTest, DimmedPointsOfADensityMapAreGreyAndGiveWayToTheOthers) {
  const std::vector<PlotPoint> dimmed(100, {0, 0, kRed, true});
  auto both = dimmed;
  both.insert(both.end(), 100, {0, 0, kGreen, false});
  const PointStyle style{.density_above = 1, .density_colours = DensityColours::mean};
  const Rgb grey = pixel(drawn_at_once(gl(), dimmed, style), 60, 80);
  EXPECT_NEAR(grey.red, grey.blue, 10);
  EXPECT_GT(grey.red, 20);
  const Rgb green = pixel(drawn_at_once(gl(), both, style), 60, 80);
  EXPECT_GT(green.green, 150);
  EXPECT_LT(green.red, 20);
}

TEST(DensityGridTest, PointsOnTheLowEdgesCountAndOnTheHighEdgesDoNot) {
  DensityGrid grid({0, 1, 0, 1}, 7, 5);
  grid.add(0, 0);
  grid.add(std::nextafter(1.0, 0.0), std::nextafter(1.0, 0.0));
  EXPECT_EQ(grid.total(), 2u);
  EXPECT_EQ(grid.cells().sums.at(2, 0, 3), 1) << "bottom left";
  EXPECT_EQ(grid.cells().sums.at(0, 3, 3), 1) << "top right";
  for (const auto& [x, y] : {std::pair{1.0, 0.5}, {0.5, 1.0}, {std::nan(""), 0.5}, {0.5, INFINITY}})
    grid.add(x, y);
  EXPECT_EQ(grid.total(), 2u);
}

TEST(DensityGridTest, CellsHoldTheExpectedShareOfAUniformCloud) {
  DensityGrid grid({0, 1, 0, 1}, 16, 16);  // 64 cells
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 64000; ++i) grid.add(uniform(random), uniform(random));
  double chi_square = 0;
  for (std::size_t i = 3; i < grid.cells().sums.pixels.size(); i += 4) {
    const float count = grid.cells().sums.pixels[i];
    chi_square += (count - 1000) * (count - 1000) / 1000;
  }
  // 63 degrees of freedom: mean 63, standard deviation 11.2.
  EXPECT_NEAR(chi_square, 63, 4 * 11.2);
}

}  // namespace
}  // namespace patina
