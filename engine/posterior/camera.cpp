#include "engine/posterior/camera.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/io/jpeg.h"

namespace patina {
namespace {

// IEC 61966-2-1.
double to_linear(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}
double to_display(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// A function on [0, 1] between the values of a table: off by less than 1e-5 for the curves above.
class Tabulated {
 public:
  explicit Tabulated(double (*function)(double)) {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] = static_cast<float>(function(static_cast<double>(i) / kSteps));
  }
  float operator()(float x) const {
    const float at = std::clamp(x, 0.0f, 1.0f) * kSteps;
    const auto i = std::min(static_cast<std::size_t>(at), values_.size() - 2);
    return values_[i] + (at - static_cast<float>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kSteps = 8192;
  std::array<float, kSteps + 1> values_{};
};

/// Normal deviates of 16 bits each, for a sensor has very many of them; the furthest is 4.3.
class Normals {
 public:
  explicit Normals(Rng& rng) : rng_(rng) {}
  float operator()() {
    static const std::vector<float> quantiles = make_quantiles();
    left_ = !left_;
    if (left_) word_ = rng_();
    return quantiles[left_ ? word_ >> 16 : word_ & 0xffff];
  }

 private:
  static std::vector<float> make_quantiles() {
    constexpr int kCells = 1 << 16;
    std::vector<float> quantiles(kCells);
    for (int i = 0; i < kCells; ++i)
      quantiles[static_cast<std::size_t>(i)] =
          static_cast<float>(Eigen::numext::ndtri((static_cast<double>(i) + 0.5) / kCells));
    return quantiles;
  }

  Rng& rng_;
  Rng::result_type word_ = 0;
  bool left_ = false;
};

}  // namespace

Image photographed(const Image& render, const Camera& camera, Rng& rng) {
  static const Tabulated linear(to_linear), display(to_display);
  const auto white = static_cast<float>(camera.electrons);
  const auto dark_variance = static_cast<float>(camera.read_noise * camera.read_noise);
  Image noisy = render;
  Normals normal(rng);
  for (float& pixel : noisy.pixels) {
    const float electrons = white * linear(pixel);
    pixel = display((electrons + std::sqrt(electrons + dark_variance) * normal()) / white);
  }
  return through_jpeg(noisy, camera.jpeg_quality);
}

}  // namespace patina
