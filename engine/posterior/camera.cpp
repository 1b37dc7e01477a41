#include "engine/posterior/camera.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

Image photographed(const Image& render, const Camera& camera, Rng& rng) {
  Image noisy = render;
  for (float& pixel : noisy.pixels) {
    const double electrons = camera.electrons * to_linear(pixel);
    const double seen =
        electrons + std::sqrt(electrons + camera.read_noise * camera.read_noise) * rng.normal();
    pixel = static_cast<float>(to_display(std::clamp(seen / camera.electrons, 0.0, 1.0)));
  }
  return through_jpeg(noisy, camera.jpeg_quality);
}

}  // namespace patina
