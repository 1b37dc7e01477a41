#include "engine/posterior/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/posterior/camera_kernel.h"

namespace patina {
namespace {

// IEC 61966-2-1.
double to_linear(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}
double to_display(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

TEST(Camera, ExposesAsItsFormulaSaysFromBlackToWhite) {
  constexpr double kWhite = 3000, kDarkVariance = 9;
  constexpr int kCount = 1021;  // no multiple of the pixels that are taken at once
  std::vector<float> pixels, normals;
  for (int i = 0; i < kCount; ++i) {
    pixels.push_back(static_cast<float>(i) / (kCount - 1));
    normals.push_back(static_cast<float>(4 * std::sin(0.7 * i)));
  }
  std::vector<float> exposed = pixels;
  camera::expose(exposed.data(), normals.data(), kCount, kWhite, kDarkVariance);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const double electrons = kWhite * to_linear(pixels[i]);
    const double counted = electrons + std::sqrt(electrons + kDarkVariance) * normals[i];
    EXPECT_NEAR(exposed[i], to_display(std::clamp(counted / kWhite, 0.0, 1.0)), 3e-6) << "pixel " << i;
  }
}

/// Of the brightness that a JPEG keeps for each pixel (ITU-R BT.601); colours it keeps for every fourth.
TEST(Camera, PhotosOfGreyHaveTheNoiseOfTheirElectrons) {
  constexpr int kSide = 128;
  Camera camera;
  camera.electrons = 1000;  // noise of three levels of brightness: rounding hardly adds to it
  camera.jpeg_quality = 100;
  Image grey(kSide, kSide, 3);
  std::ranges::fill(grey.pixels, 0.5f);
  Rng rng(5);
  const Image photo = photographed(grey, camera, rng);
  double mean = 0, square = 0;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double brightness = 0.299 * photo.at(row, column, 0) + 0.587 * photo.at(row, column, 1) +
                                0.114 * photo.at(row, column, 2);
      mean += brightness / (kSide * kSide);
      square += brightness * brightness / (kSide * kSide);
    }
  const double linear = to_linear(0.5), electrons = camera.electrons * linear;
  const double slope = (to_display(linear + 1e-4) - to_display(linear - 1e-4)) / 2e-4;
  const double sd = slope * std::sqrt(electrons + camera.read_noise * camera.read_noise) / camera.electrons;
  const double weights = 0.299 * 0.299 + 0.587 * 0.587 + 0.114 * 0.114;
  EXPECT_NEAR(mean, 0.5, 0.003);
  EXPECT_NEAR(square - mean * mean, weights * sd * sd, 0.1 * weights * sd * sd);
}

}  // namespace
}  // namespace patina
