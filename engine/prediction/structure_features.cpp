#include "engine/prediction/structure_features.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/reflection_pad2d.h>

#include <vector>

#include "engine/io/photo.h"
#include "engine/prediction/gram_features.h"
#include "engine/summary/gram.h"
#include "engine/summary/image_tensor.h"
#include "engine/summary/network.h"
#include "engine/summary/tensor_index.h"

namespace patina {
namespace {

constexpr int kScales = 2;

/// @param planes [1, n, n]
at::Tensor mean_nearby(const at::Tensor& planes) {
  const std::int64_t radius = planes.size(1) / 16, width = 2 * radius + 1;
  const at::Tensor padded = at::reflection_pad2d(planes.unsqueeze(0), {radius, radius, radius, radius});
  const at::Tensor columns = at::avg_pool2d(padded, {width, 1}, {1, 1});
  return at::avg_pool2d(columns, {1, width}, {1, 1}).squeeze(0);
}

/// [3, n, n], grey, in [0,1] about 0.5, of a luminance [1, n, n].
at::Tensor structure_of(const at::Tensor& luminance) {
  // Of display values, of a local spread, and of that of the whole: what is less is noise.
  constexpr double kBlack = 0.02, kLeastLocal = 0.02, kLeast = 0.01;
  constexpr double kContrast = 0.15;
  const at::Tensor logarithm = (luminance + kBlack).log();
  const at::Tensor detail = logarithm - mean_nearby(logarithm);
  const at::Tensor even = detail / (mean_nearby(detail.square()).sqrt() + kLeastLocal);
  const double spread = even.square().mean().sqrt().item<double>();
  return (0.5 + kContrast * even / (spread + kLeast)).clamp(0, 1).expand({3, -1, -1}).contiguous();
}

}  // namespace

StructureFeatures::StructureFeatures()
    : covariances_(std::make_shared<const GramMatrices>(Network::load(bundled_network()),
                                                        GramMatrices::About::mean)) {}

Eigen::Index StructureFeatures::size() const {
  Eigen::Index size = 0;
  for (const SummaryBlock& block : covariances_->blocks()) size += gram_features_of(block);
  return kScales * size;
}

Eigen::VectorXf StructureFeatures::operator()(const Image& photo) const {
  const at::NoGradGuard no_grad;
  at::Tensor luminance = to_tensor(resized(photo, kSide)).mean(0, /*keepdim=*/true);
  std::vector<float> features;
  for (int scale = 0; scale < kScales; ++scale) {
    const at::Tensor covariances = (*covariances_)(structure_of(luminance)).contiguous();
    const float* entry = covariances.data_ptr<float>();
    for (const SummaryBlock& block : covariances_->blocks()) {
      append_gram(block, entry, features);
      entry += block.size;
    }
    luminance = at::avg_pool2d(luminance.unsqueeze(0), {2, 2}, {2, 2}).squeeze(0);
  }
  return Eigen::Map<const Eigen::VectorXf>(features.data(), std::ssize(features));
}

}  // namespace patina
