#include "engine/summary/texture_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/sampling/rng.h"
#include "engine/summary/image_tensor.h"
#include "engine/summary/network.h"
#include "tests/summary/naive.h"

namespace patina {
namespace {

constexpr int kSide = 128;

/// Waves of a colour about another, display values.
Image waves(double amplitude, double mean, double cycles) {
  Image image(kSide, kSide, 3);
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column)
      for (int k = 0; k < 3; ++k)
        image.pixels[static_cast<std::size_t>((row * kSide + column) * 3 + k)] = static_cast<float>(
            mean + amplitude * (k + 1) * std::sin(2 * M_PI * (cycles * row / kSide + 0.1 * column / kSide)));
  return image;
}

/// Covariances, entry by entry, of what a network makes of a picture.
std::vector<std::vector<double>> naive_covariances(const Image& image) {
  std::vector<std::vector<double>> levels;
  for (const at::Tensor& features : Network::load(bundled_network()).features(to_tensor(image))) {
    naive::Maps maps = naive::from_tensor(features);
    const auto pixels = static_cast<std::size_t>(maps.height * maps.width);
    for (std::size_t channel = 0; channel < static_cast<std::size_t>(maps.channels); ++channel) {
      double mean = 0;
      for (std::size_t i = 0; i < pixels; ++i)
        mean += maps.values[channel * pixels + i] / static_cast<double>(pixels);
      for (std::size_t i = 0; i < pixels; ++i) maps.values[channel * pixels + i] -= mean;
    }
    levels.push_back(naive::gram(maps));
  }
  return levels;
}

TEST(TextureDistance, IsThatOfCovariancesOverAllPairsOfChannels) {
  const Image photo = waves(0.05, 0.4, 6), other = waves(0.1, 0.5, 9);
  const auto a = naive_covariances(photo), b = naive_covariances(other);
  double expected = 0;
  for (std::size_t level = 0; level < a.size(); ++level) {
    double first = 0, second = 0, between = 0;
    for (std::size_t i = 0; i < a[level].size(); ++i) {
      first += a[level][i] * a[level][i], second += b[level][i] * b[level][i];
      between += (a[level][i] - b[level][i]) * (a[level][i] - b[level][i]);
    }
    expected +=
        2 * std::sqrt(between) / (std::sqrt(first) + std::sqrt(second)) / static_cast<double>(a.size());
  }
  EXPECT_GT(expected, 0.1);
  EXPECT_NEAR(TextureDistance(photo, kSide, {})(other), expected, 1e-4 * expected);
}

TEST(TextureDistance, IsNothingToThePictureItselfAndTheSameBothWays) {
  const Image photo = waves(0.05, 0.4, 6), other = waves(0.1, 0.5, 9);
  EXPECT_EQ(TextureDistance(photo, kSide, {})(photo), 0);
  EXPECT_NEAR(TextureDistance(photo, kSide, {})(other), TextureDistance(other, kSide, {})(photo), 1e-6);
}

/// Squares of independent greys.
Image grains(int side, std::uint64_t seed) {
  Rng rng(seed, 0);
  Image image(kSide, kSide, 3);
  for (int row = 0; row < kSide; row += side)
    for (int column = 0; column < kSide; column += side) {
      const double grey = 0.5 + 0.1 * rng.normal();
      for (int i = 0; i < side * side * 3; ++i)
        image.at(row + i / 3 / side, column + i / 3 % side, i % 3) = static_cast<float>(grey);
    }
  return image;
}

TEST(TextureDistance, SeesAnotherGrainRatherThanOtherPlaces) {
  const TextureDistance to(grains(2, 1), kSide, {});
  EXPECT_LT(2 * to(grains(2, 2)), to(grains(4, 3)));
}

TEST(TextureDistance, OfWhatHasNoTextureIsTwoAtMost) {
  const double distance = TextureDistance(waves(0.05, 0.4, 6), kSide, {})(waves(0, 0.4, 1));
  EXPECT_GT(distance, 1.9);
  EXPECT_LE(distance, 2);
}

}  // namespace
}  // namespace patina
