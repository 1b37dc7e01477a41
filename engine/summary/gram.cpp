#include "engine/summary/gram.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/mm.h>
#include <ATen/ops/triu_indices.h>
#include <ATen/ops/where.h>
#include <ATen/ops/zeros.h>
#include <torch/csrc/autograd/custom_function.h>

#include <numbers>

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
Triangle upper_triangle(std::int64_t channels, const at::Tensor& like) {
  const at::Tensor upper = at::triu_indices(channels, channels, 0, like.options().dtype(at::kLong));
  return {upper[0] * channels + upper[1],
          at::where(upper[0] == upper[1], 1.0, std::numbers::sqrt2).to(like.scalar_type())};
}

/// On the processor, up to so many channels our own products are faster than a BLAS, which is made for
/// matrices that are large both ways (bench-summary).
constexpr std::int64_t kFewChannels = 96;

bool is_small(const at::Tensor& pixels) {
  return pixels.is_cpu() && pixels.size(1) <= kFewChannels && pixels.scalar_type() == at::kFloat;
}

/// @param pixels  [pixels, channels]   @param gram  [channels, channels], written
void gram_matrix(const at::Tensor& pixels, at::Tensor gram) {
  if (is_small(pixels))
    features::gram(pixels.data_ptr<float>(), pixels.size(0), pixels.size(1), gram.data_ptr<float>());
  else
    at::mm_out(gram, pixels.t(), pixels).div_(static_cast<double>(pixels.size(0)));
}

/// @param pixels  [pixels, channels]   @param matrix  [channels, channels]   @param result  as pixels,
/// written
void product(const at::Tensor& pixels, const at::Tensor& matrix, at::Tensor result) {
  if (is_small(pixels))
    features::times(pixels.data_ptr<float>(), pixels.size(0), pixels.size(1), matrix.data_ptr<float>(),
                    result.data_ptr<float>());
  else
    at::mm_out(result, pixels, matrix);
}

/// gram_vector() with its gradient as one product: with W that by G, F (W + W^T) is that by F.
struct GramVector : torch::autograd::Function<GramVector> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& features) {
    const std::int64_t images = features.size(0), channels = features.size(1);
    const at::Tensor pixels = features.permute({0, 2, 3, 1})
                                  .reshape({images, -1, channels})
                                  .contiguous();  // no copy if channels last
    context->save_for_backward({pixels});
    context->saved_data["rows"] = features.size(2);
    const at::Tensor grams = at::empty({images, channels, channels}, pixels.options());
    for (std::int64_t i = 0; i < images; ++i) gram_matrix(pixels[i], grams[i]);
    const Triangle triangle = upper_triangle(channels, features);
    return grams.view({images, -1}).index_select(1, triangle.places) * triangle.weights;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const at::Tensor pixels = context->get_saved_variables().front();
    const std::int64_t images = pixels.size(0), channels = pixels.size(2);
    const Triangle triangle = upper_triangle(channels, pixels);
    const at::Tensor by_gram = at::zeros({images, channels * channels}, pixels.options())
                                   .index_copy(1, triangle.places, outputs.front() * triangle.weights)
                                   .view({images, channels, channels});
    const at::Tensor twice =
        ((by_gram + by_gram.transpose(1, 2)) / static_cast<double>(pixels.size(1))).contiguous();
    const at::Tensor by_pixels = at::empty_like(pixels);
    for (std::int64_t i = 0; i < images; ++i) product(pixels[i], twice[i], by_pixels[i]);
    return {
        by_pixels.view({images, context->saved_data["rows"].toInt(), -1, channels}).permute({0, 3, 1, 2})};
  }
};

/// What the features' means alone make of a Gram matrix, as gram_vector() has it.
at::Tensor gram_of_means(const at::Tensor& features) {
  const at::Tensor means = features.mean({2, 3});
  const Triangle triangle = upper_triangle(features.size(1), features);
  const at::Tensor products = means.unsqueeze(2) * means.unsqueeze(1);
  return products.flatten(1).index_select(1, triangle.places) * triangle.weights;
}

}  // namespace

at::Tensor gram_vector(const at::Tensor& features) { return GramVector::apply(features); }

at::Tensor covariance_vector(const at::Tensor& features) {
  return gram_vector(features) - gram_of_means(features);
}

at::Tensor GramMatrices::of(const at::Tensor& images) const {
  std::vector<at::Tensor> grams, covariances;
  for (const at::Tensor& features : network_.features(images)) {
    if (about_ == About::mean) {
      covariances.push_back(covariance_vector(features));
      continue;
    }
    grams.push_back(gram_vector(features));
    if (about_ == About::both) covariances.push_back(grams.back() - gram_of_means(features));
  }
  grams.insert(grams.end(), covariances.begin(), covariances.end());
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
