// Maps that repeat, border by border, and how large what they show is. Plain images: no tensors.

#include "engine/material/tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"

namespace patina {
namespace {

constexpr int kTileSize = 256;

/// The prior's mean, with features of several pixels and, where there are shifts, off centre.
ParameterValues coarse_features(const ParameterTable& table) {
  ParameterValues values = prior_location(table);
  const auto set = [&](const char* name, double value) {
    if (const auto i = table.find_continuous(name)) values.continuous[*i] = value;
  };
  set("scale", 0.25);
  set("shift_x", 0.31);
  set("shift_y", -0.17);
  set("fsigma", 0.5);
  set("fsigmay", 0.5);
  set("noise_scale", 0.001);
  set("ring_size", 0.8);
  set("ssn_scale", 1);
  return values;
}

double& value_of(const ParameterTable& table, ParameterValues& values, const char* name) {
  return values.continuous[table.find_continuous(name).value()];
}

/// All that is drawn on a surface, and the height: what continues over a border, mirrored or not.
std::vector<Image> plain_maps(const MaterialMaps& maps) {
  std::vector<Image> images{maps.base_color, maps.height};
  for (const LobeMaps& lobe : maps.lobes) images.push_back(lobe.roughness);
  return images;
}

std::vector<Image> all_maps(const MaterialMaps& maps) {
  std::vector<Image> images = plain_maps(maps);
  images.push_back(maps.normal);
  for (const LobeMaps& lobe : maps.lobes) images.push_back(lobe.normal);
  return images;
}

/// Root mean square of the steps from each column (or row) to the next one; last, from the last to the first.
std::vector<double> steps(const Image& image, bool between_rows) {
  const int n = image.width;
  std::vector<double> all(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double sum = 0;
    for (int k = 0; k < n; ++k)
      for (int c = 0; c < image.channels; ++c) {
        const int next = (i + 1) % n;
        const double step = between_rows ? image.at(next, k, c) - image.at(i, k, c)
                                         : image.at(k, next, c) - image.at(k, i, c);
        sum += step * step;
      }
    all[static_cast<std::size_t>(i)] = std::sqrt(sum / n);
  }
  return all;
}

/// The largest, over maps and directions, of the step over the border relative to the largest step inside.
double worst_seam(const std::vector<Image>& images) {
  double worst = 0;
  for (const Image& image : images)
    for (const bool between_rows : {false, true}) {
      const std::vector<double> all = steps(image, between_rows);
      const double inside = *std::max_element(all.begin(), all.end() - 1);
      worst = std::max(worst, all.back() / (inside + 1e-6));
    }
  return worst;
}

double largest_difference(const std::vector<Image>& a, const std::vector<Image>& b, const auto& place_in_b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int row = 0; row < a[i].height; ++row)
      for (int column = 0; column < a[i].width; ++column) {
        const auto [other_row, other_column] = place_in_b(row, column);
        for (int c = 0; c < a[i].channels; ++c)
          largest = std::max<double>(largest,
                                     std::abs(a[i].at(row, column, c) - b[i].at(other_row, other_column, c)));
      }
  return largest;
}

class TileOf : public testing::TestWithParam<std::string> {
 protected:
  Renderer renderer{GetParam(), 3, Capture{}};
  ParameterValues values = coarse_features(renderer.table());
};

using EveryTile = TileOf;

TEST_P(EveryTile, ContinuesOnTheOppositeSideOfItsBorders) {
  const MaterialMaps tile = renderer.tile(values, kTileSize);
  EXPECT_EQ(tile.resolution(), kTileSize);
  EXPECT_LE(worst_seam(GetParam() == "wood" ? plain_maps(tile) : all_maps(tile)), 1);
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryTile,
                         testing::Values("bump", "metal", "leather", "plaster", "flake", "wood"),
                         [](const auto& info) { return info.param; });

/// Materials whose sample is not a period.
using OpenSample = TileOf;

TEST_P(OpenSample, HasASeamUnlessATileIsAskedFor) {
  EXPECT_GT(worst_seam(all_maps(renderer.maps(values, kTileSize))), 1.3);
}

INSTANTIATE_TEST_SUITE_P(Materials, OpenSample, testing::Values("leather", "plaster", "flake", "wood"),
                         [](const auto& info) { return info.param; });

/// Materials that look maps up.
using MapTile = TileOf;

TEST_P(MapTile, ShowsTheSampleInItsMiddleAndItsSurroundings) {
  const MaterialMaps sample = renderer.maps(values, kTileSize / 4), tile = renderer.tile(values, kTileSize);
  EXPECT_DOUBLE_EQ(tile.capture.size_cm, 4 * sample.capture.size_cm);
  constexpr int kMargin = (kTileSize - kTileSize / 4) / 2;
  EXPECT_LT(
      largest_difference(all_maps(sample), all_maps(tile),
                         [](int row, int column) { return std::pair(row + kMargin, column + kMargin); }),
      2e-3);
}

TEST_P(MapTile, MovedByPixelsIsTheTileRolled) {
  constexpr int kRight = 37, kDown = 100;
  const MaterialMaps tile = renderer.tile(values, kTileSize);
  const double pixel = 2 / value_of(renderer.table(), values, "scale") / kTileSize;
  value_of(renderer.table(), values, "shift_x") += kRight * pixel;
  value_of(renderer.table(), values, "shift_y") += kDown * pixel;
  EXPECT_LT(largest_difference(all_maps(renderer.tile(values, kTileSize)), all_maps(tile),
                               [](int row, int column) {
                                 return std::pair((row + kDown) % kTileSize, (column + kRight) % kTileSize);
                               }),
            2e-3);
}

INSTANTIATE_TEST_SUITE_P(Materials, MapTile, testing::Values("leather", "plaster", "flake"),
                         [](const auto& info) { return info.param; });

TEST(TileOfWood, IsTheSampleWithItsMirrorImages) {
  const Renderer renderer("wood", 3, Capture{});
  const ParameterValues values = coarse_features(renderer.table());
  const MaterialMaps sample = renderer.maps(values, 64), tile = renderer.tile(values, 128);
  EXPECT_DOUBLE_EQ(tile.capture.size_cm, 2 * sample.capture.size_cm);
  const auto reflected = [](int i) { return i < 64 ? i : 127 - i; };
  EXPECT_EQ(
      largest_difference(plain_maps(tile), plain_maps(sample),
                         [&](int row, int column) { return std::pair(reflected(row), reflected(column)); }),
      0);
  for (const auto& [row, column] : {std::pair(10, 20), {10, 100}, {90, 20}, {90, 100}}) {
    const int r = reflected(row), c = reflected(column);
    EXPECT_EQ(tile.normal.at(row, column, 0), sample.normal.at(r, c, 0) * (column < 64 ? 1 : -1));
    EXPECT_EQ(tile.normal.at(row, column, 1), sample.normal.at(r, c, 1) * (row < 64 ? 1 : -1));
    EXPECT_EQ(tile.normal.at(row, column, 2), sample.normal.at(r, c, 2));
  }
}

TEST(Tile, IsRefusedWhereThereIsNone) {
  const Renderer translucent("translucent", 1, Capture{}), wood("wood", 1, Capture{});
  EXPECT_THROW(translucent.tile(prior_location(translucent.table()), 64), UserError);
  for (const int resolution : {30, 33, 5000})
    EXPECT_THROW(wood.tile(prior_location(wood.table()), resolution), UserError) << resolution;
}

}  // namespace
}  // namespace patina
