#include "engine/prediction/photo_features.h"

#include <ATen/core/grad_mode.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/io/photo.h"
#include "engine/summary/image_tensor.h"
#include "engine/summary/summary.h"

namespace patina {
namespace {

constexpr Eigen::Index kMostCorrelated = 32;  // channels of a Gram matrix of which all correlations are taken
constexpr float kFaint = 1e-6f;               // of an energy, where Gram matrices have norms about 1

/// How many channels a Gram matrix has, from the size of its upper triangle.
Eigen::Index channels_of(const SummaryBlock& block) {
  return std::llround((std::sqrt(1 + 8.0 * static_cast<double>(block.size)) - 1) / 2);
}

Eigen::Index features_of(const SummaryBlock& block) {
  if (block.scale != ErrorScale::relative) return block.size;
  const Eigen::Index channels = channels_of(block);
  return channels <= kMostCorrelated ? block.size : channels;
}

/// Of an upper triangle row by row, off-diagonal entries times sqrt 2: logarithms of the diagonal, then
/// correlations row by row.
void append_gram(const float* triangle, Eigen::Index channels, std::vector<float>& features) {
  std::vector<float> energies;
  for (Eigen::Index i = 0, at = 0; i < channels; at += channels - i, ++i)
    energies.push_back(std::max(triangle[at], 0.0f) + kFaint);
  for (const float energy : energies) features.push_back(std::log(energy));
  if (channels > kMostCorrelated) return;
  for (Eigen::Index i = 0, at = 0; i < channels; ++i, ++at)
    for (Eigen::Index j = i + 1; j < channels; ++j) {
      const float both = energies[static_cast<std::size_t>(i)] * energies[static_cast<std::size_t>(j)];
      features.push_back(triangle[++at] / (std::numbers::sqrt2_v<float> * std::sqrt(both)));
    }
}

}  // namespace

PhotoFeatures::PhotoFeatures(int side) : side_(side), summary_(make_summary("gram+rings+bands", {})) {}

Eigen::Index PhotoFeatures::size() const {
  Eigen::Index size = 2;  // of the capture
  for (const SummaryBlock& block : summary_->blocks()) size += features_of(block);
  return size;
}

Eigen::VectorXf PhotoFeatures::operator()(const Image& photo, const Capture& capture) const {
  const at::NoGradGuard no_grad;
  const at::Tensor summary = (*summary_)(to_tensor(resized(photo, side_))).contiguous();
  const float* entry = summary.data_ptr<float>();
  std::vector<float> features;
  for (const SummaryBlock& block : summary_->blocks()) {
    if (block.scale == ErrorScale::relative)
      append_gram(entry, channels_of(block), features);
    else
      features.insert(features.end(), entry, entry + block.size);
    entry += block.size;
  }
  features.push_back(static_cast<float>(std::log(capture.size_cm)));
  features.push_back(static_cast<float>(std::log(capture.camera_cm / capture.size_cm)));
  return Eigen::Map<const Eigen::VectorXf>(features.data(), std::ssize(features));
}

}  // namespace patina
