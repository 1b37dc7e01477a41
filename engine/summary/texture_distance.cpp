#include "engine/summary/texture_distance.h"

#include <ATen/core/grad_mode.h>

#include <cassert>
#include <cmath>

#include "engine/io/photo.h"
#include "engine/summary/gram.h"
#include "engine/summary/image_tensor.h"
#include "engine/summary/network.h"

namespace patina {

TextureDistance::TextureDistance(const Image& photo, int resolution, const std::filesystem::path& network)
    : resolution_(resolution),
      network_(std::make_unique<const Network>(Network::load(network.empty() ? bundled_network() : network))),
      photo_(covariances(resized(photo, resolution))) {}

TextureDistance::~TextureDistance() = default;

std::vector<TextureDistance::Level> TextureDistance::covariances(const Image& image) const {
  const at::NoGradGuard no_gradients;
  std::vector<Level> levels;
  for (const at::Tensor& features : network_->features(to_tensor(image))) {
    const at::Tensor vector = covariance_vector(features).contiguous();
    levels.emplace_back(vector.data_ptr<float>(), vector.data_ptr<float>() + vector.numel());
  }
  return levels;
}

double TextureDistance::operator()(const Image& render) const {
  assert(render.width == resolution_);
  const std::vector<Level> levels = covariances(render);
  double total = 0;
  for (std::size_t k = 0; k < photo_.size(); ++k) {
    double own = 0, other = 0, between = 0;
    for (std::size_t i = 0; i < photo_[k].size(); ++i) {
      const double a = photo_[k][i], b = levels[k][i];
      own += a * a, other += b * b, between += (a - b) * (a - b);
    }
    const double size = 0.5 * (std::sqrt(own) + std::sqrt(other));
    if (size > 0) total += std::sqrt(between) / size;
  }
  return total / static_cast<double>(photo_.size());
}

}  // namespace patina
