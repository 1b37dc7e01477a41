#include "engine/posterior/camera.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <vector>

#include "engine/io/jpeg.h"
#include "engine/posterior/camera_kernel.h"

namespace patina {
namespace {

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
  Image noisy = render;
  std::vector<float> normals(noisy.pixels.size());
  std::ranges::generate(normals, Normals(rng));
  camera::expose(noisy.pixels.data(), normals.data(), std::ssize(normals),
                 static_cast<float>(camera.electrons),
                 static_cast<float>(camera.read_noise * camera.read_noise));
  return through_jpeg(noisy, camera.jpeg_quality);
}

}  // namespace patina
