#include "engine/summary/gram.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/addmm.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/mean.h>
#include <ATen/ops/mm.h>
#include <ATen/ops/triu_indices.h>
#include <ATen/ops/where.h>
#include <c10/core/InferenceMode.h>
#include <torch/csrc/autograd/custom_function.h>

#include <map>
#include <mutex>
#include <numbers>
#include <tuple>

#include "engine/summary/feature_kernel.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// The upper triangle of a matrix: where its entries lie, row by row, and their weights.
struct Triangle {
  at::Tensor places, weights;
};

/// @param like  a tensor of the weights' type and device
Triangle make_triangle(std::int64_t channels, const at::Tensor& like) {
  const c10::InferenceMode normal_mode(false);  // a tensor born otherwise could never serve a gradient
  const at::Tensor upper = at::triu_indices(channels, channels, 0, like.options().dtype(at::kLong));
  return {upper[0] * channels + upper[1],
          at::where(upper[0] == upper[1], 1.0, std::numbers::sqrt2).to(like.scalar_type())};
}

/// Kept: a network has a handful. Safe to call from several threads.
Triangle upper_triangle(std::int64_t channels, const at::Tensor& like) {
  static std::mutex mutex;
  static std::map<std::tuple<std::int64_t, at::DeviceType, at::ScalarType>, Triangle> kept;
  const std::lock_guard lock(mutex);
  const auto [place, is_new] = kept.try_emplace({channels, like.device().type(), like.scalar_type()});
  if (is_new) place->second = make_triangle(channels, like);
  return place->second;
}

/// On the processor, up to so many channels our own products are faster than a BLAS, which is made for
/// matrices that are large both ways (bench-summary).
constexpr std::int64_t kFewChannels = 96;

bool is_small(const at::Tensor& pixels) {
  return pixels.is_cpu() && pixels.size(1) <= kFewChannels && pixels.scalar_type() == at::kFloat;
}

/// @param pixels  [pixels, channels]   @param means  [channels], written
/// @param products  [channels, channels], written
void moments_of(const at::Tensor& pixels, at::Tensor means, at::Tensor products) {
  if (is_small(pixels)) {
    features::moments(pixels.data_ptr<float>(), pixels.size(0), pixels.size(1), means.data_ptr<float>(),
                      products.data_ptr<float>());
  } else {
    at::mm_out(products, pixels.t(), pixels).div_(static_cast<double>(pixels.size(0)));
    at::mean_out(means, pixels, 0);
  }
}

/// @param pixels  [pixels, channels]   @param matrix  [channels, channels]   @param row  [channels]
/// @param result  as pixels, written
void product(const at::Tensor& pixels, const at::Tensor& matrix, const at::Tensor& row, at::Tensor result) {
  if (is_small(pixels))
    features::times(pixels.data_ptr<float>(), pixels.size(0), pixels.size(1), matrix.data_ptr<float>(),
                    row.data_ptr<float>(), result.data_ptr<float>());
  else
    at::addmm_out(result, row, pixels, matrix);
}

/// The means [k, channels] of a feature map [k, channels, h, w] and those of products [k, channels,
/// channels], with the gradient of both as one product: with W that by the products and m that by the means,
/// it is F (W + W^T) + m, over the pixels.
struct Moments : torch::autograd::Function<Moments> {
  static variable_list forward(AutogradContext* context, const at::Tensor& features) {
    const std::int64_t images = features.size(0), channels = features.size(1);
    const at::Tensor pixels = features.permute({0, 2, 3, 1})
                                  .reshape({images, -1, channels})
                                  .contiguous();  // no copy if channels last
    context->save_for_backward({pixels});
    context->saved_data["rows"] = features.size(2);
    const at::Tensor means = at::empty({images, channels}, pixels.options()),
                     products = at::empty({images, channels, channels}, pixels.options());
    for (std::int64_t i = 0; i < images; ++i) moments_of(pixels[i], means[i], products[i]);
    return {means, products};
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const at::Tensor pixels = context->get_saved_variables().front();
    const std::int64_t images = pixels.size(0), channels = pixels.size(2);
    const auto count = static_cast<double>(pixels.size(1));
    const at::Tensor by_products = outputs[1];
    const at::Tensor twice = ((by_products + by_products.transpose(1, 2)) / count).contiguous(),
                     row = (outputs[0] / count).contiguous(), by_pixels = at::empty_like(pixels);
    for (std::int64_t i = 0; i < images; ++i) product(pixels[i], twice[i], row[i], by_pixels[i]);
    return {
        by_pixels.view({images, context->saved_data["rows"].toInt(), -1, channels}).permute({0, 3, 1, 2})};
  }
};

struct MomentsOf {
  at::Tensor means, products;
  explicit MomentsOf(const at::Tensor& features) {
    const variable_list both = Moments::apply(features);
    means = both[0];
    products = both[1];
  }
};

/// @param matrices  [k, c, c], symmetric   @return [k, c (c + 1) / 2], as gram_vector() has it
at::Tensor as_vector(const at::Tensor& matrices) {
  const Triangle triangle = upper_triangle(matrices.size(1), matrices);
  return matrices.flatten(1).index_select(1, triangle.places) * triangle.weights;
}

at::Tensor covariances(const MomentsOf& moments) {
  return as_vector(moments.products - moments.means.unsqueeze(2) * moments.means.unsqueeze(1));
}

}  // namespace

at::Tensor gram_vector(const at::Tensor& features) { return as_vector(MomentsOf(features).products); }

at::Tensor covariance_vector(const at::Tensor& features) { return covariances(MomentsOf(features)); }

at::Tensor GramMatrices::of(const at::Tensor& images) const {
  std::vector<at::Tensor> grams, about_means;
  for (const at::Tensor& features : network_.features(images)) {
    const MomentsOf moments(features);
    if (about_ != About::mean) grams.push_back(as_vector(moments.products));
    if (about_ != About::zero) about_means.push_back(covariances(moments));
  }
  grams.insert(grams.end(), about_means.begin(), about_means.end());
  return at::cat(grams, 1).to(at::kCPU);
}

std::vector<SummaryBlock> GramMatrices::blocks() const {
  std::vector<SummaryBlock> blocks;
  const int views = about_ == About::both ? 2 : 1;
  const auto add = [&](const std::string& name) {
    int level = 0;
    for (const std::int64_t channels : network_.feature_channels())
      blocks.push_back(
          {name + " " + std::to_string(++level), channels * (channels + 1) / 2, ErrorScale::relative, views});
  };
  if (about_ != About::mean) add("gram");
  if (about_ != About::zero) add("covariances");
  return blocks;
}

}  // namespace patina
