// Features keep their place and their size in centimetres from the coarsest image to the finest one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/material/registry.h"
#include "engine/material/renderer.h"

namespace patina {
namespace {

constexpr int kCoarse = 64, kFine = 4096;

/// Features of several of the coarse image's pixels.
ParameterValues large_features(const ParameterTable& table) {
  ParameterValues values = prior_location(table);
  const auto set = [&](const char* name, double value) {
    if (const auto i = table.find_continuous(name)) values.continuous[*i] = value;
  };
  set("scale", 0.05);
  set("fsigma", 0.2);
  set("fsigmay", 0.2);
  set("noise_scale", 0.001);
  set("ring_size", 6);
  set("ssn_scale", 0.3);
  return values;
}

/// One channel of a map that has something to show, averaged over blocks to kCoarse pixels a side.
class Feature {
 public:
  Feature(const Image& map, int channel) : pixels_(kCoarse * kCoarse) {
    const int side = map.width / kCoarse;
    for (int row = 0; row < map.height; ++row)
      for (int column = 0; column < map.width; ++column)
        pixels_[place(row / side, column / side)] += map.at(row, column, channel) / double(side) / side;
  }

  double sd() const {
    double sum = 0, squares = 0;
    for (const double pixel : pixels_) sum += pixel, squares += pixel * pixel;
    return std::sqrt(std::max(0.0, squares / count() - sum * sum / count() / count()));
  }

  /// Correlation with another one, moved down and to the right by some pixels.
  double correlation(const Feature& other, int pixels) const {
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (int row = pixels; row < kCoarse; ++row)
      for (int column = pixels; column < kCoarse; ++column) {
        const double x = pixels_[place(row, column)];
        const double y = other.pixels_[place(row - pixels, column - pixels)];
        ++n, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
      }
    return (ab / n - a * b / n / n) / std::sqrt((aa / n - a * a / n / n) * (bb / n - b * b / n / n));
  }

 private:
  static std::size_t place(int row, int column) { return static_cast<std::size_t>(row) * kCoarse + column; }
  double count() const { return static_cast<double>(pixels_.size()); }

  std::vector<double> pixels_;
};

/// What each material shows at every resolution without differences between pixels.
Feature feature(const std::string& material, const MaterialMaps& maps) {
  if (material == "translucent" || material == "wood") return {maps.base_color, 0};
  if (material == "flake") return {maps.lobes[1].normal, 0};
  return {maps.height, 0};
}

class EveryMaterialFrom64To4096Pixels : public testing::TestWithParam<std::string> {};

TEST_P(EveryMaterialFrom64To4096Pixels, HasItsFeaturesAtTheSamePlacesAndOfTheSameStrength) {
  const Renderer renderer(GetParam(), 3, Capture{});
  const ParameterValues values = large_features(renderer.table());
  const Feature coarse = feature(GetParam(), renderer.maps(values, kCoarse)),
                fine = feature(GetParam(), renderer.maps(values, kFine));
  EXPECT_GT(coarse.correlation(fine, 0), 0.98);
  EXPECT_LT(coarse.correlation(fine, 1), coarse.correlation(fine, 0) - 0.01);
  EXPECT_NEAR(fine.sd() / coarse.sd(), 1, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryMaterialFrom64To4096Pixels, testing::ValuesIn(material_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace patina
