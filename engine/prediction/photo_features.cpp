#include "engine/prediction/photo_features.h"

#include <ATen/core/grad_mode.h>

#include <cmath>
#include <vector>

#include "engine/io/photo.h"
#include "engine/posterior/resampling.h"
#include "engine/prediction/gram_features.h"
#include "engine/summary/image_tensor.h"
#include "engine/summary/summary.h"

namespace patina {
namespace {

Eigen::Index features_of(const SummaryBlock& block) {
  return block.scale == ErrorScale::relative ? gram_features_of(block) : block.size;
}

}  // namespace

PhotoFeatures::PhotoFeatures(int side)
    : side_(side),
      resampling_(std::make_shared<const Resampling>(side)),
      summary_(make_summary("gram+rings+bands", {})) {}

Eigen::Index PhotoFeatures::size() const {
  Eigen::Index size = 2;  // of the capture
  for (const SummaryBlock& block : summary_->blocks()) size += features_of(block);
  return size;
}

Eigen::VectorXf PhotoFeatures::operator()(const Image& photo, const Capture& capture) const {
  const at::NoGradGuard no_grad;
  // Simulated photos are small, and many of a size; a photograph comes once.
  constexpr int kSmall = 512;
  const at::Tensor image =
      photo.width <= kSmall ? (*resampling_)(to_tensor(photo)) : to_tensor(resized(photo, side_));
  const at::Tensor summary = (*summary_)(image).contiguous();
  const float* entry = summary.data_ptr<float>();
  std::vector<float> features;
  for (const SummaryBlock& block : summary_->blocks()) {
    if (block.scale == ErrorScale::relative)
      append_gram(block, entry, features);
    else
      features.insert(features.end(), entry, entry + block.size);
    entry += block.size;
  }
  features.push_back(static_cast<float>(std::log(capture.size_cm)));
  features.push_back(static_cast<float>(std::log(capture.camera_cm / capture.size_cm)));
  return Eigen::Map<const Eigen::VectorXf>(features.data(), std::ssize(features));
}

}  // namespace patina
